// Profiles of highlights, with and without their scene.
#include "cli/options.hpp"
#include "compare/profile/blob.hpp"
#include "core/image_io.hpp"
#include "farm/profile_scene.hpp"
#include "python/module.hpp"
#include "records/record.hpp"

namespace lobelia::python {
namespace {

/// One or two pictures, read or copied.
struct Pictures {
  std::vector<std::string> names;
  std::vector<std::string> files;
  std::vector<Image> images;

  explicit Pictures(const py::list& given) {
    for (const py::handle one : given) {
      const auto picture = py::reinterpret_borrow<py::object>(one);
      names.emplace_back(names.empty() ? "a" : "b");
      files.push_back(is_path(picture) ? path_of(picture) : "");
      images.push_back(files.back().empty() ? image_of(picture, names.back()) : Image());
    }
  }
  NamedImages read() {
    NamedImages named;
    for (std::size_t i = 0; i < images.size(); ++i) {
      if (!files[i].empty()) images[i] = read_image(files[i]);
      named.emplace_back(names[i], &images[i]);
    }
    return named;
  }
};

std::string blobs(const py::list& given, std::optional<std::array<double, 2>> at,
                  std::optional<std::array<int, 4>> region, double least) {
  if (!(least >= 0 && least <= 1))
    throw Error(ExitCode::kUsage, fmt::format("least {} is out of range; allowed: 0 to 1", least));
  Pictures pictures(given);
  BlobOptions options;
  options.search.least_share = least;
  if (at) options.search.at = {(*at)[0], (*at)[1]};
  if (region) options.region = {(*region)[0], (*region)[1], (*region)[2], (*region)[3]};
  std::string text;
  run(py::none(), [&](const ShowProgress&) {
    const NamedImages images = pictures.read();
    const records::Blobs record = blobs_record(measure_blobs(images, options), least);
    text = at ? records::record_text(record.highlights.front()) : records::record_text(record);
  });
  return text;
}

std::string profiles(const py::list& given, const py::object& scene_text, std::optional<int> light,
                     std::optional<int> sphere, const py::dict& given_options) {
  Pictures pictures(given);
  cli::SceneOverrides overrides;
  parse_options(given_options, [&](CLI::App& app) { overrides.add_to(app); });
  Scene scene = scene_of(scene_text);
  overrides.apply(scene);
  std::string text;
  run(py::none(), [&](const ShowProgress& show) {
    const NamedImages images = pictures.read();
    if (light || sphere) {
      text = records::record_text(
          profile_scene(scene, light.value_or(0), sphere.value_or(0), images, true));
      return;
    }
    const auto highlights = highlights_of(scene);
    if (highlights.empty())
      throw Error(ExitCode::kInput, "scene: no sphere of it has a highlight, or there is no light");
    records::Profiles all;
    for (const auto& [on, of] : highlights) {
      all.profiles.push_back(profile_scene(scene, of, on, images, true));
      show(double(all.profiles.size()) / double(highlights.size()));
    }
    text = records::record_text(all);
  });
  return text;
}

}  // namespace

void add_profile(py::module_& module) {
  module.def("blobs", &blobs);
  module.def("profiles", &profiles);
}

}  // namespace lobelia::python
