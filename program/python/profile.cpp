// Profiles of highlights, with and without their scene.
#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "farm/profile_scene.hpp"
#include "profile/blob.hpp"
#include "profile/measure_noise.hpp"
#include "profile/require_same_size.hpp"
#include "program/command/options.hpp"
#include "program/python/module.hpp"

namespace lobelia::python {
namespace {

/// A path, or an array that was copied.
struct PictureOrPath {
  std::string name, file;
  Image image;

  PictureOrPath(const py::object& given, std::string letter) : name(std::move(letter)) {
    if (is_path(given))
      file = path_of(given);
    else
      image = image_of(given, name);
  }
  Image read() { return file.empty() ? std::move(image) : read_image(file); }
  const std::string& shown() const { return file.empty() ? name : file; }
};

/// A picture, with its standard errors or independent pictures of the same.
struct MeasuredPicture {
  std::string name;
  PictureOrPath picture;
  std::optional<PictureOrPath> error;
  std::vector<PictureOrPath> replicates;
  Image image;
  std::optional<PictureNoise> noise;

  /// (picture, error or None, replicates)
  MeasuredPicture(const py::tuple& given, const std::string& letter)
      : name(letter), picture(given[0], letter) {
    if (!given[1].is_none()) error.emplace(given[1], letter + "'s error");
    for (const py::handle one : given[2])
      replicates.emplace_back(py::reinterpret_borrow<py::object>(one), letter + "'s replicate");
  }

  void read() {
    image = picture.read();
    const auto beside = [&](PictureOrPath& other) {
      Image read = other.read();
      require_same_size(image, read, picture.shown(), other.shown());
      return read;
    };
    // The pixels of a renderer's picture share their sample points.
    if (error) noise = noise_of_standard_errors(beside(*error), kFreedomOfErrors, true);
    if (replicates.empty()) return;
    std::vector<Image> others;
    for (PictureOrPath& replicate : replicates) others.push_back(beside(replicate));
    noise = noise_of_replicates(image, std::move(others));
  }
};

/// One or two pictures.
struct Pictures {
  std::vector<MeasuredPicture> all;

  explicit Pictures(const py::list& given) {
    for (const py::handle one : given)
      all.emplace_back(py::reinterpret_borrow<py::tuple>(one), all.empty() ? "a" : "b");
  }
  NamedImages read() {
    NamedImages named;
    for (MeasuredPicture& one : all) {
      one.read();
      named.emplace_back(one.name, &one.image);
    }
    return named;
  }
  std::vector<const PictureNoise*> noise() const {
    std::vector<const PictureNoise*> found;
    for (const MeasuredPicture& one : all) found.push_back(one.noise ? &*one.noise : nullptr);
    return found;
  }
};

std::string blobs(const py::list& given, std::optional<std::array<double, 2>> at,
                  std::optional<std::array<int, 4>> region, double least) {
  if (!(least >= 0 && least <= 1))
    throw Error(ExitCode::kUsage, "least {} is out of range; allowed: 0 to 1", least);
  Pictures pictures(given);
  BlobOptions options;
  options.search.least_share = least;
  if (at) options.search.at = {(*at)[0], (*at)[1]};
  if (region) options.region = {(*region)[0], (*region)[1], (*region)[2], (*region)[3]};
  std::string text;
  run(py::none(), [&](const ShowProgress&) {
    const NamedImages images = pictures.read();
    options.noise = pictures.noise();
    const records::Blobs record = blobs_record(measure_blobs(images, options), least);
    text = at ? records::record_text(record.highlights.front()) : records::record_text(record);
  });
  return text;
}

std::string profiles(const py::list& given, const py::object& scene_text, std::optional<int> light,
                     std::optional<int> sphere, const py::dict& given_options) {
  Pictures pictures(given);
  cli::SceneOverrides overrides;
  cli::FilterOption filter;
  parse_options(given_options, [&](CLI::App& app) {
    overrides.add_to(app);
    cli::OptionGroup group(app);
    filter.add_to(group);
  });
  Scene scene = scene_of(scene_text);
  overrides.apply(scene);
  std::optional<PixelsShow> shown;
  if (const auto means = filter.apply(scene.film))
    shown = *means ? PixelsShow::kMeans : PixelsShow::kCentres;
  std::string text;
  run(py::none(), [&](const ShowProgress& show) {
    const NamedImages images = pictures.read();
    if (light || sphere) {
      text = records::record_text(profile_scene(scene, light.value_or(0), sphere.value_or(0),
                                                images, true, pictures.noise(), shown));
      return;
    }
    const auto highlights = highlights_of(scene);
    if (highlights.empty())
      throw Error(ExitCode::kInput, "scene: no sphere of it has a highlight, or there is no light");
    records::Profiles all;
    for (const auto& [on, of] : highlights) {
      all.profiles.push_back(profile_scene(scene, of, on, images, true, pictures.noise(), shown));
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
