// Comparisons of two pictures, and their maps.
#include "compare/compare.hpp"

#include <algorithm>
#include <cmath>

#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "base/system/threads.hpp"
#include "base/words/text.hpp"
#include "compare/maps/difference_map.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/set/run.hpp"
#include "program/command/compare/compare_options.hpp"
#include "program/command/compare/replaced_references.hpp"
#include "program/python/module.hpp"

namespace lobelia::python {
namespace {

/// A comparison with its pictures, from which maps are made.
struct Compared {
  PicturePair pictures;
  PairReport report;
  std::string record;
};

/// A comparison of folders, or of another set of pictures.
struct ComparedSet {
  std::string record, text, markdown;
  bool passed;
};

/// Whether a choice is for folders, or for pictures that a project or a table names.
bool is_for_set(const CompareChoice& choice) {
  const auto is_several = [](const std::string& path) {
    std::error_code none;
    return std::filesystem::is_directory(path, none) || is_sequence(path);
  };
  return !choice.project.empty() || !choice.pairs.empty() || !choice.pattern.empty() ||
         !choice.also_accept.empty() || std::ranges::any_of(choice.given, is_several);
}

/// A picture of the pair: a file to be read, or an array.
struct Side {
  std::string name;
  std::optional<ArrayPicture> array;
  bool is_file = false;

  Side(const py::object& given, const std::string& letter) : name(letter), is_file(is_path(given)) {
    if (is_file)
      name = path_of(given);
    else
      array = picture_of(given, letter);
  }
  /// Reads a file, so that it can be compared with an array.
  void read() {
    if (!is_file) return;
    array = ArrayPicture{read_picture(name, ""), {}, {}};
    const std::string& alpha = array->picture.source.alpha;
    if (!alpha.empty()) array->alpha = read_picture(name, alpha).image;
  }
  Picture alpha() const {
    Picture made;
    made.source = array->picture.source;
    made.source.layer = "A";
    made.source.channels = {"A"};
    made.image = Image(array->picture.image.width(), array->picture.image.height());
    std::ranges::fill(made.image.values(), 1.0f);
    if (array->alpha) made.image = *array->alpha;
    return made;
  }
};

/// Pixels that either array masks count as equal.
void ignore_masked(const Side& a, const Side& b, CompareJob& job) {
  std::vector<MaskShape> shapes;
  for (const Side* side : {&a, &b})
    if (side->array->masked)
      shapes.push_back({fmt::format("masked values of {}", side->name), *side->array->masked});
  job.parts.change({}, shapes, job.comparison);
}

PairReport compare_arrays(Side& a, Side& b, PairReport report, PicturePair& pair, CompareJob& job) {
  a.read();
  b.read();
  ignore_masked(a, b, job);
  // A file's alpha counts where the array has one, too.
  const bool has_alpha = (a.array->alpha && b.array->alpha) || (!a.is_file && a.array->alpha) ||
                         (!b.is_file && b.array->alpha);
  std::optional<PicturePair> alpha;
  if (has_alpha) alpha = PicturePair{a.alpha(), b.alpha()};
  pair = {std::move(a.array->picture), std::move(b.array->picture)};
  return compare_in_memory(job, std::move(report), pair, std::move(alpha));
}

ComparedSet compare_set(const CompareChoice& choice, const py::object& progress) {
  ComparedSet compared;
  run(progress, [&](const ShowProgress& show) {
    const CompareJob job = make_job(choice, cli::scene_parts);
    const Pairing pairing = cli::pair_finished(job.pictures);
    check_companions(job, pairing);
    const double count = double(pairs_of(pairing).size());
    ThreadLimit(choice.threads).run([&] {
      const SetReport report =
          compare_pairs(job, pairing, [&](std::size_t done) { show(double(done) / count); });
      require_pairs(report);
      compared = {records::record_text(set_record(report)), counts_text(report),
                  set_markdown(report), set_exit_code(report) == ExitCode::kSuccess};
    });
  });
  return compared;
}

std::shared_ptr<Compared> compare_two_pictures(const py::object& a, const py::object& b,
                                               const CompareChoice& choice) {
  if (!choice.reference_floor.empty())
    throw Error(ExitCode::kUsage, "reference_floor is for folders and projects");
  auto compared = std::make_shared<Compared>();
  Side side_a(a, "a"), side_b(b, "b");
  const bool files = side_a.is_file && side_b.is_file;
  if (!files && (!choice.layer.empty() || choice.all_layers))
    throw Error(ExitCode::kUsage, "layer and all_layers are for two files; an array has no layers");
  run(py::none(), [&](const ShowProgress&) {
    ThreadLimit(choice.threads).run([&] {
      CompareJob job = make_job(choice, cli::scene_parts);
      PairReport& report = compared->report;
      report.a = side_a.name;
      report.b = side_b.name;
      PicturePair& pair = compared->pictures;
      if (files) {
        pair = read_two(job, report);
        report = compare_two(job, std::move(report), pair);
      } else {
        report = compare_arrays(side_a, side_b, std::move(report), pair, job);
      }
      compared->record = records::record_text(pair_record(report));
    });
  });
  return compared;
}

/// A Compared, or of folders a ComparedSet.
py::object compare(const py::object& a, const py::object& b, const py::dict& given,
                   const py::object& progress) {
  CompareChoice choice = read_choice(given_options(given));
  for (const py::object& picture : {a, b})
    if (is_path(picture)) choice.given.push_back(path_of(picture));
  if (is_for_set(choice)) {
    for (const auto& [picture, letter] : {std::pair(a, "a"), std::pair(b, "b")})
      if (!picture.is_none() && !is_path(picture))
        throw Error(ExitCode::kUsage, "{} is no path; of a set, both are folders or files", letter);
    return py::cast(compare_set(choice, progress));
  }
  if (a.is_none() || b.is_none())
    throw Error(ExitCode::kUsage,
                "a and b are required: two pictures or two folders; or pairs or project");
  return py::cast(compare_two_pictures(a, b, choice));
}

const DifferenceMap& map_of(const std::string& id) {
  const std::vector<std::string_view> names = difference_map_names();
  return *chosen(id, "map", names, [](const std::string& name) {
    const DifferenceMap* const found = find_difference_map(name);
    return found ? std::optional(found) : std::nullopt;
  });
}

/// (height, width) float32.
py::array map_array(const Compared& compared, const std::string& id) {
  const DifferenceMap& map = map_of(id);
  const Image &a = compared.pictures.a.image, &b = compared.pictures.b.image;
  auto values = std::make_unique<PixelValues>();
  run(py::none(), [&](const ShowProgress&) {
    *values = measure_difference_map(map, a, b, compared.report.comparison->viewing);
  });
  PixelValues* const kept = values.get();
  const py::capsule owner(kept, [](void* one) { delete static_cast<PixelValues*>(one); });
  values.release();
  return py::array_t<float>(std::vector<py::ssize_t>{a.height(), a.width()}, kept->data(), owner);
}

/// The map's own scale: to its largest value, to 1, or over the exposures.
ColourScale scale_of(const DifferenceMap& map, std::span<const float> values,
                     const Viewing& viewing) {
  if (map.scale == MapScale::kExposures)
    return {viewing.hdr_exposures->start_stops, viewing.hdr_exposures->stop_stops};
  if (map.scale == MapScale::kOne) return 1;
  double largest = 0;
  for (const float value : values)
    if (std::isfinite(value)) largest = std::max(largest, double(std::abs(value)));
  return largest > 0 ? largest : 1;
}

py::bytes map_png(const Compared& compared, const std::string& id) {
  const DifferenceMap& map = map_of(id);
  const Image &a = compared.pictures.a.image, &b = compared.pictures.b.image;
  const Viewing& viewing = compared.report.comparison->viewing;
  const std::string_view colours = !map.colours.empty() ? map.colours
                                   : map.is_signed      ? kSignedColourMap
                                                        : kDefaultColourMap;
  DisplayImage picture;
  run(py::none(), [&](const ShowProgress&) {
    const PixelValues values = measure_difference_map(map, a, b, viewing);
    picture =
        colour_picture(values, a.width(), a.height(), scale_of(map, values, viewing), colours);
  });
  return png_of(picture);
}

}  // namespace

void add_compare(py::module_& module) {
  py::class_<Compared, std::shared_ptr<Compared>>(module, "Compared")
      .def_property_readonly("record", [](const Compared& one) { return py::str(one.record); })
      .def_property_readonly("passed",
                             [](const Compared& one) { return is_pass(one.report.verdict()); })
      .def_property_readonly("verdict",
                             [](const Compared& one) { return verdict_name(one.report.verdict()); })
      .def_property_readonly(
          "highlight",
          [](const Compared& one) { return highlight_sentence(*one.report.comparison); })
      .def_property_readonly("why", [](const Compared& one) { return why_not_pass(one.report); })
      .def_property_readonly("a",
                             [](const py::object& one) {
                               return view_of(one.cast<const Compared&>().pictures.a.image, one);
                             })
      .def_property_readonly("b",
                             [](const py::object& one) {
                               return view_of(one.cast<const Compared&>().pictures.b.image, one);
                             })
      .def("map", &map_array)
      .def("map_png", &map_png);
  py::class_<ComparedSet>(module, "ComparedSet")
      .def_readonly("record", &ComparedSet::record)
      .def_readonly("text", &ComparedSet::text)
      .def_readonly("markdown", &ComparedSet::markdown)
      .def_readonly("passed", &ComparedSet::passed);
  module.def("compare", &compare);
  module.def("map_names", [] {
    std::vector<std::string> names;
    for (const DifferenceMap& map : difference_maps()) names.emplace_back(map.id);
    return names;
  });
}

}  // namespace lobelia::python
