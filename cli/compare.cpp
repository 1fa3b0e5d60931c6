#include "compare/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "cli/between.hpp"
#include "cli/commands.hpp"
#include "cli/compare_noise.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/metrics/flip_exposures.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/text.hpp"
#include "renderer/scene/scene_io.hpp"
#include "verify/truth/evaluation.hpp"

namespace lobelia::cli {
namespace {

struct Options {
  std::string a, b, json, tolerance, exposures, scene, difference_picture;
  std::vector<std::string> fail;
  double difference_scale = 0;
  NoiseFlags noise;
  ComparisonOptions comparison;
};

MetricLimit parse_limit(const std::string& text) {
  // The last one: an id may have one of its own, as relmse.eps=0.01 has.
  const std::size_t equals = text.rfind('=');
  MetricLimit limit{text.substr(0, equals), 0};
  if (equals == std::string::npos || !parse_number(text.substr(equals + 1), limit.limit))
    throw Error(
        ExitCode::kUsage,
        fmt::format("--fail {}: expected METRIC=LIMIT, for example rmse=0.001", printable(text)));
  return limit;
}

Tolerance parse_tolerance(const std::string& text) {
  const std::vector<std::string> parts = split(text, ",");
  Tolerance tolerance;
  long long outliers = 0;
  if (parts.size() != 3 || !parse_number(parts[0], tolerance.relative) ||
      !parse_number(parts[1], tolerance.of_peak) || !parse_integer(parts[2], outliers))
    throw Error(ExitCode::kUsage,
                fmt::format("--tolerance {}: expected RELATIVE,OF_PEAK,OUTLIERS, for example "
                            "6e-4,1e-6,3",
                            printable(text)));
  tolerance.allowed_outliers = outliers;
  return tolerance;
}

constexpr std::string_view kAutomatic = "auto";

HdrExposures parse_exposures(const std::string& text) {
  // Of an automatic range the numbers come from the reference, once it is read.
  if (text == kAutomatic) return {0, 0, 2, true};
  const std::vector<std::string> parts = split(text, ",");
  HdrExposures range;
  long long count = 0;
  if (parts.size() != 3 || !parse_number(parts[0], range.start_stops) ||
      !parse_number(parts[1], range.stop_stops) || !parse_integer(parts[2], count))
    throw Error(
        ExitCode::kUsage,
        fmt::format("--exposures {}: expected START,STOP,COUNT, for example -6,2,9, or auto",
                    printable(text)));
  range.count = int(std::clamp<long long>(count, 0, kMaxHdrExposures + 1));
  return range;
}

bool is_finite(const Image& image) {
  return std::all_of(image.values().begin(), image.values().end(),
                     [](float value) { return std::isfinite(value); });
}

/// "± 0.0012  " where noise is known; a column that is empty for figures without an error bar.
std::string error_bar_text(const Comparison& comparison, std::string_view id) {
  if (!comparison.uncertainty) return "";
  const ErrorBar* bar = comparison.uncertainty->bar(id);
  return fmt::format("{:<12}", bar ? fmt::format("± {:.2g}", bar->standard_error) : "");
}

void print_table(const Options& options, const Comparison& comparison) {
  fmt::print("a  {}\nb  {}  (the reference)\n\n", options.a, options.b);
  if (comparison.verdict == Verdict::kNonFinite)
    fmt::print("  pixels with a NaN or an infinity: {} in a, {} in b; nothing was measured\n",
               comparison.nonfinite_a, comparison.nonfinite_b);
  for (const MetricValue& metric : comparison.metrics)
    fmt::print("  {:<16}{:>14.6g}  {}{}\n", metric.id, metric.value,
               error_bar_text(comparison, metric.id), metric.meaning);
  fmt::print("\n");
  if (comparison.verdict != Verdict::kNonFinite)
    for (const LimitResult& limit : comparison.limits)
      fmt::print("  {:<16}{:>14.6g}  {} {:g}\n", limit.metric, limit.value,
                 std::isnan(limit.value)             ? "was NOT MEASURED; the limit is"
                 : limit.pass                        ? "is within"
                 : limit.standing == Standing::kOpen ? "MAY BE ON EITHER SIDE OF"
                                                     : "is OUTSIDE",
                 limit.limit);
  for (const LimitResult& limit : comparison.limits)
    if (std::isfinite(limit.more_samples) && limit.more_samples > 0)
      fmt::print("  about {:.3g} times the samples would tell about {}\n", limit.more_samples,
                 limit.metric);
  for (const std::string& sentence : comparison.disagreement)
    fmt::print("  metrics disagree: {}\n", sentence);
  fmt::print("{}verdict: {}\n", comparison.verdict == Verdict::kNonFinite ? "" : "\n",
             verdict_name(comparison.verdict));
}

ExitCode run(Options options) {
  for (const std::string& text : options.fail)
    options.comparison.limits.push_back(parse_limit(text));
  if (!options.tolerance.empty()) options.comparison.tolerance = parse_tolerance(options.tolerance);
  std::optional<HdrExposures>& exposures = options.comparison.viewing.hdr_exposures;
  if (!options.exposures.empty()) exposures = parse_exposures(options.exposures);
  if (!options.scene.empty()) {
    const Scene scene = read_scene(options.scene);
    options.comparison.mask = truth::surface_mask(scene);
    if (options.comparison.tolerance) options.comparison.tolerance->edges = truth::edge_ring(scene);
  }
  options.noise.apply(options.comparison);
  check_options(options.comparison);
  const bool json_to_file = !options.json.empty() && options.json != "-";
  if (json_to_file) require_writable(options.json);
  if (!options.difference_picture.empty()) require_writable(options.difference_picture);

  Image a = read_image(options.a), b = read_image(options.b);
  options.noise.read(a, b, options.comparison);
  // One that is not finite is a verdict, and nothing is measured.
  if (exposures && exposures->automatic && is_finite(b)) exposures = automatic_exposures(b);
  const Comparison comparison = compare(a, b, options.comparison);
  if (!options.difference_picture.empty()) {
    // Without a scale the largest difference is white; one that is not finite is magenta anyway.
    const double largest = comparison.value("max_abs");
    const double white_at = options.difference_scale > 0 ? options.difference_scale
                            : largest > 0                ? largest
                                                         : 1.0;
    write_png(options.difference_picture, difference_picture(a, b, white_at));
    fmt::print(stderr, "{}: white is a difference of {:.6g}\n", options.difference_picture,
               white_at);
  }
  const Json record = comparison_record(comparison, options.a, options.b);
  if (json_to_file) write_record(options.json, record);
  if (options.json == "-")
    fmt::print("{}", record_text(record));
  else
    print_table(options, comparison);
  return is_pass(comparison.verdict) ? ExitCode::kSuccess : ExitCode::kDiffers;
}

std::string footer() {
  std::string defaults;
  for (const MetricLimit& limit : default_limits())
    defaults += fmt::format("{}{} {:g}", defaults.empty() ? "" : ", ", limit.metric, limit.limit);
  return fmt::format(
      "Metrics that a limit can be set on:\n"
      "  {}\n"
      "Without --fail and --tolerance the limits are {}: a look, not a proof.\n"
      "Pictures of 8 or 16 bits (PNG, JPEG) are decoded from sRGB to linear light, clipped as they are.\n"
      "A NaN or an infinity in either picture is a verdict of its own and never passes.\n"
      "Where noise is known the verdict is same, different, or undecided: the noise leaves it open, and\n"
      "more samples are needed (docs/metrics.md).\n"
      "\n"
      "Examples:\n"
      "  lobelia compare ours.exr povray.exr\n"
      "  lobelia compare ours.exr povray.exr --tolerance 6e-4,1e-8,3 --scene scene.xml\n"
      "  lobelia compare ours.exr blender.exr --fail max_rel_peak=3e-5 --fail flip.ldr.mean=1e-3\n"
      "  lobelia compare half1.exr reference.exr --a-replicate half2.exr --b-error error.exr\n"
      "\n"
      "Exit codes: 0 pass or same, 1 over a limit, undecided or not finite, 2 usage, 3 a picture is\n"
      "unreadable or the sizes differ, 4 an output cannot be written.",
      join(limit_names()), defaults);
}

}  // namespace

void add_compare(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand("compare", "Compare two pictures: metrics and a verdict");
  auto options = std::make_shared<Options>();
  Viewing& viewing = options->comparison.viewing;
  command->add_option("A", options->a, "Picture to judge")->required();
  command->add_option("B", options->b, "Reference picture, of the same size")->required();
  command
      ->add_flag_callback(
          "--list-metrics",
          [] {
            fmt::print("{}", metrics_document());
            throw CLI::Success();
          },
          "List the metrics: id, family, direction, meaning, source (docs/metrics.md)")
      ->trigger_on_parse()  // before A and B are asked for
      ->group("Output");

  command
      ->add_option(
          "--fail", options->fail,
          "Verdict 'differs' if METRIC is over LIMIT (a likeness, such as psnr: below it); may be given again")
      ->type_name("METRIC=LIMIT")
      ->expected(1)
      ->take_all()
      ->group("Verdict");
  command
      ->add_option(
          "--tolerance", options->tolerance,
          "A pixel is an outlier if |A - B| > REL * |B| + PEAK * (brightest value of B) in "
          "any channel; verdict 'differs' if there are more than COUNT")
      ->type_name("REL,PEAK,COUNT")
      ->group("Verdict");
  command
      ->add_option(
          "--scene", options->scene,
          "Measure errors on the pixels that see a surface of this scene as well (ids in "
          ".mask); with --tolerance, outliers may lie only on its silhouettes, terminators "
          "and shadow edges")
      ->group("Verdict");

  options->noise.add_to(*command);

  command
      ->add_option(
          "--exposure", viewing.exposure_stops,
          "Exposure at which the perceptual metrics look at the pictures, HDR-FLIP excepted")
      ->type_name("STOPS")
      ->check(between(-kMaxExposureStops, kMaxExposureStops))
      ->capture_default_str()
      ->group("Viewing");
  command
      ->add_option(
          "--exposures", options->exposures,
          "Measure HDR-FLIP over COUNT exposures from START to STOP, in stops, shown through "
          "the ACES curve; with auto over the range that the reference alone suggests")
      ->type_name("START,STOP,COUNT|auto")
      ->group("Viewing");
  command
      ->add_option("--pixels-per-degree", viewing.pixels_per_degree,
                   "How many pixels of the display a degree of the viewer's eye sees, for FLIP")
      ->type_name("NUMBER")
      ->check(between(kMinPixelsPerDegree, kMaxPixelsPerDegree))
      ->capture_default_str()
      ->group("Viewing");

  command
      ->add_option("--json", options->json,
                   "Write the record (kind comparison) to FILE; with - to stdout, and no table")
      ->type_name("FILE|-")
      ->group("Output");
  auto* picture = command->add_option("--diff-image", options->difference_picture,
                                      "Write |A - B| per channel as a picture");
  picture->type_name("FILE.png")->group("Output");
  command
      ->add_option("--diff-scale", options->difference_scale,
                   "The difference that is shown as white; default: the largest")
      ->type_name("NUMBER")
      ->check(CLI::PositiveNumber)
      ->needs(picture)
      ->group("Output");
  command->footer(footer());
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace lobelia::cli
