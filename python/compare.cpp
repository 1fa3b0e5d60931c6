// Comparisons of two pictures, and their maps.
#include "compare/compare.hpp"

#include <algorithm>
#include <cmath>

#include "cli/compare_arguments.hpp"
#include "cli/options.hpp"
#include "cli/replaced_references.hpp"
#include "compare/maps/difference_map.hpp"
#include "compare/metrics/catalogue.hpp"
#include "core/image_io.hpp"
#include "core/text.hpp"
#include "core/threads.hpp"
#include "python/module.hpp"
#include "records/record.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/scene/scene_io.hpp"

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

/// The options of compare(): those of the command line that write no files.
struct CompareOptions : cli::CompareArguments {
  void add_to(CLI::App& app) {
    cli::OptionGroup group(app);
    group.add("--pairs", job.pictures.csv, "", "");
    group.add("--pattern", job.pictures.pattern, "", "");
    group.add("--sets", job.pictures.sets, "", "");
    group.add("--also-accept", job.pictures.also_accepted, "", "")->expected(1)->take_all();
    group.add("--project", project, "", "");
    group.add("--reference-floor", job.c, "", "");
    group.add("--fail", fail, "", "")->expected(1)->take_all();
    group.add("--warn", warn, "", "")->expected(1)->take_all();
    group.add("--metrics", metrics, "", "");
    group.add("--tolerance", tolerance, "", "");
    group.add("--scene", job.scene, "", "");
    group.add("--layer", layer, "", "");
    group.add("--ocio", display.config, "", "");
    group.add("--display", display.display, "", "");
    group.add("--view", display.view, "", "");
    group.add("--input-space", display.input_space, "", "");
    group.add_flag("--all-layers", job.layers.all, "");
    group.add_flag("--ignore-alpha", job.layers.ignore_alpha, "");
    group.add_flag("--no-default-limits", no_default_limits, "");
    group.add_flag("--allow-equal-nonfinite", job.comparison.allow_equal_nonfinite, "");
    group.add_number("--threads", threads, 0, 1024, "");
    job.regions.add_to(app);
    job.noise.add_to(app);
    viewing.add_to(app, job.comparison.viewing);
  }

  /// As `lobelia compare` does before it reads the pictures.
  void apply() {
    ComparisonOptions& options = job.comparison;
    options.highlight = true;
    options.default_limits = !no_default_limits;
    for (const std::string& text : fail) options.limits.push_back(cli::parse_limit("limits", text));
    for (const std::string& text : warn)
      options.warnings.push_back(cli::parse_limit("warnings", text));
    options.metrics = split(metrics, ",");
    if (!tolerance.empty()) options.tolerance = cli::parse_tolerance("tolerance", tolerance);
    if (!project.empty()) cli::apply_project(*this);
    job.layers.layer = parse_layer_names(layer);
    viewing.apply(options.viewing);
    options.viewing.display = DisplayView::open(display);
    if (!job.scene.empty()) {
      const Scene shown = read_scene(job.scene);
      options.surfaces = truth::surface_mask(shown);
      options.mask_of = {job.scene};
      if (options.tolerance) options.tolerance->edges = truth::edge_ring(shown);
      for (cli::PairRule& rule : job.rules)
        if (rule.tolerance) rule.tolerance->edges = truth::edge_ring(shown);
    }
    job.regions.read(options);
    job.noise.apply(options);
    check_options(options);
  }

  /// Whether they are for folders, or for pictures that a project or a table names.
  bool is_for_set() const {
    const PairingChoice& pictures = job.pictures;
    const auto is_several = [](const std::string& path) {
      std::error_code none;
      return std::filesystem::is_directory(path, none) || is_sequence(path);
    };
    return !project.empty() || !pictures.csv.empty() || !pictures.pattern.empty() ||
           !pictures.also_accepted.empty() || std::ranges::any_of(pictures.given, is_several);
  }
};

/// A picture of the pair: a file to be read, or an array that is one already.
struct Side {
  std::string name;
  std::optional<Picture> picture;

  Side(const py::object& given, const std::string& letter) {
    if (is_path(given)) {
      name = path_of(given);
      return;
    }
    name = letter;
    picture = {{image_of(given, letter), {}, {}}};
  }
  Picture read(const std::string& layer) {
    return picture ? std::move(*picture) : read_picture(name, layer);
  }
  bool is_file() const { return !picture; }
};

/// Exposures that suit the reference, or the reason why there are none.
void choose_exposures(const Image& reference, HdrExposures& exposures) {
  try {
    exposures = automatic_exposures(reference, exposures);
  } catch (const Error& error) {
    exposures.problem = error.what();
  }
}

ComparedSet compare_set(CompareOptions& options, const py::object& progress) {
  ComparedSet compared;
  run(progress, [&](const ShowProgress& show) {
    options.apply();
    const Pairing pairing = cli::pair_finished(options.job.pictures);
    cli::check_companions(options.job, pairing);
    const double count = double(cli::pairs_of(pairing).size());
    ThreadLimit(options.threads).run([&] {
      const SetReport report = cli::compare_pairs(
          options.job, pairing, [&](std::size_t done) { show(double(done) / count); });
      cli::require_pairs(report);
      compared = {records::record_text(set_record(report)), counts_text(report),
                  set_markdown(report), set_exit_code(report) == ExitCode::kSuccess};
    });
  });
  return compared;
}

std::shared_ptr<Compared> compare_two(const py::object& a, const py::object& b,
                                      CompareOptions& options) {
  if (!options.job.c.empty())
    throw Error(ExitCode::kUsage, "reference_floor is for folders and projects");
  auto compared = std::make_shared<Compared>();
  Side side_a(a, "a"), side_b(b, "b");
  const bool files = side_a.is_file() && side_b.is_file();
  if (!files && (!options.layer.empty() || options.job.layers.all))
    throw Error(ExitCode::kUsage, "layer and all_layers are for two files; an array has no layers");
  run(py::none(), [&](const ShowProgress&) {
    ThreadLimit(options.threads).run([&] {
      options.apply();
      ComparisonOptions& how = options.job.comparison;
      PairReport& report = compared->report;
      PicturePair& pair = compared->pictures;
      report.a = side_a.name;
      report.b = side_b.name;
      Pairing pairing;
      pairing.is_one_row = true;
      if (files) {
        pair = cli::read_compared(report, options.job, pairing, how);
        report.sources = {pair.a.source, pair.b.source};
      } else {
        pair = {side_a.read(""), side_b.read("")};
        options.job.noise.read("", report, pair, how);
        if (!how.surfaces.empty() && how.surfaces.size() != pair.a.image.pixel_count())
          throw Error(ExitCode::kInput,
                      fmt::format("a has {} x {} pixels, the film of {} {}", pair.a.image.width(),
                                  pair.a.image.height(), options.job.scene, how.surfaces.size()));
        options.job.regions.apply(pair.b.image.width(), pair.b.image.height(), how);
        take_part(pair, report.a, report.b, how);
      }
      if (how.viewing.hdr_exposures && how.viewing.hdr_exposures->automatic)
        choose_exposures(pair.b.image, *how.viewing.hdr_exposures);
      report.comparison = compare_pictures(pair, report.a, report.b, how);
      if (files) report.layers = compare_others(report.a, report.b, pair, options.job.layers, how);
      compared->record = records::record_text(pair_record(report));
    });
  });
  return compared;
}

/// A Compared, or of folders a ComparedSet.
py::object compare(const py::object& a, const py::object& b, const py::dict& given,
                   const py::object& progress) {
  CompareOptions options;
  parse_options(given, [&](CLI::App& app) { options.add_to(app); });
  for (const py::object& picture : {a, b})
    if (is_path(picture)) options.job.pictures.given.push_back(path_of(picture));
  if (options.is_for_set()) {
    for (const auto& [picture, letter] : {std::pair(a, "a"), std::pair(b, "b")})
      if (!picture.is_none() && !is_path(picture))
        throw Error(ExitCode::kUsage,
                    fmt::format("{} is no path; of a set, both are folders or files", letter));
    return py::cast(compare_set(options, progress));
  }
  if (a.is_none() || b.is_none())
    throw Error(ExitCode::kUsage,
                "a and b are required: two pictures or two folders; or pairs or project");
  return py::cast(compare_two(a, b, options));
}

const DifferenceMap& map_of(const std::string& id) {
  const std::vector<std::string_view> names = difference_map_names();
  return *chosen(id, "map", names, join(names), [](const std::string& name) {
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
