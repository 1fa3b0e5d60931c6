// The table of `lobelia compare` on stdout.
#include <fmt/color.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/words/text.hpp"
#include "compare/highlights/words.hpp"
#include "compare/metrics/catalogue.hpp"
#include "program/command/compare/compare_pictures.hpp"

namespace lobelia::cli {
namespace {

/// Red for what fails, yellow for what may, green for a pass; plain without `colour`.
std::string painted(std::string_view text, std::optional<Problem::Weight> weight, bool colour) {
  if (!colour) return std::string(text);
  const fmt::terminal_color paint = !weight ? fmt::terminal_color::green
                                    : weight == Problem::Weight::kFails
                                        ? fmt::terminal_color::red
                                        : fmt::terminal_color::yellow;
  return fmt::format(fmt::fg(paint), "{}", text);
}

std::string layer_reasons(const LayerComparison& layer, const std::string& a,
                          const std::string& b) {
  if (layer.identical) return "identical";
  if (!layer.comparison) return layer.problem;
  const Comparison& comparison = *layer.comparison;
  if (comparison.verdict == Verdict::kNonFinite) return why_not_pass(comparison, a, b);
  std::string text;
  for (const LimitResult& limit : comparison.limits)
    text += fmt::format("{}{} {:.4g}{}", text.empty() ? "" : ", ", limit.metric, limit.value,
                        limit.pass ? "" : fmt::format(" (limit {:g})", limit.limit));
  if (!comparison.finding.empty()) text += "; " + comparison.finding;
  return text;
}

void print_layer_names(const char* where, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    fmt::print("  only in {}: {}\n", where, name.empty() ? "the picture" : printable(name));
}

/// The verdict and the limits of each layer, the layers of one file alone, and what was not compared.
void print_layers(const OtherLayers& layers, const std::string& a, const std::string& b) {
  if (!layers.compared.empty() || layers.common) fmt::print("\n");
  for (const LayerComparison& layer : layers.compared)
    fmt::print("  {}: {}; {}\n", layer.title(), verdict_name(layer.verdict()),
               layer_reasons(layer, a, b));
  if (layers.common) {
    print_layer_names("a", layers.common->only_a);
    print_layer_names("b", layers.common->only_b);
  }
  if (!is_empty(layers.not_compared))
    fmt::print("  not compared: {}\n", to_text(layers.not_compared));
}

void print_reading(const PairReport& pair) {
  const auto [a, b] = reading_of(pair);
  for (const auto& [name, facts] : {std::pair('a', &a), {'b', &b}})
    for (const auto& [what, words] : *facts) fmt::print("  {}: {}: {}\n", name, what, words);
}

void print_names(const std::string& a, const std::string& b, const std::string& c) {
  fmt::print("a  {}\nb  {}  (the reference)\n", printable_path(a), printable_path(b));
  if (!c.empty()) fmt::print("c  {}  (the second reference)\n", printable_path(c));
}

/// "± 0.0012  "; blank for a figure without an error bar, "" where no noise is known.
std::string error_bar_text(const Comparison& comparison, std::string_view id) {
  if (!comparison.uncertainty) return "";
  const ErrorBar* bar = records::find(comparison.error_bars, id);
  return fmt::format("{:<12}", bar ? fmt::format("± {:.2g}", bar->standard_error) : "");
}

void print_exposures(const Viewing& viewing) {
  if (!viewing.tail_stops) return;
  std::string further;
  for (const double stops : viewing.further_stops) further += fmt::format(", {:.3g}", stops);
  fmt::print(
      "  shown at {:.3g} stops for the peak and at {:.3g} for the tail{}; the worse counts\n\n",
      viewing.exposure_stops, *viewing.tail_stops,
      further.empty() ? "" : ", and for dimmer highlights at" + further.substr(1));
}

/// Noise with heavy tails, by picture.
void print_noise(const Comparison& comparison) {
  if (!comparison.uncertainty) return;
  for (const auto& [name, noise] :
       {std::pair('a', &comparison.uncertainty->a), {'b', &comparison.uncertainty->b}})
    if (*noise && (*noise)->heavy_tails.value_or(false))
      fmt::print(
          "  {}'s noise has heavy tails: in {:.2g} % of its pixels, fireflies err over {:g} times as "
          "much as all around them\n\n",
          name, 100 * (*noise)->fireflies.value_or(0), kFireflyFactor);
}

void print_parts(const Comparison& comparison) {
  const auto print = [](std::string_view what, std::span<const std::string> of,
                        std::int64_t pixels) {
    std::string shapes;
    for (const std::string& shape : of)
      shapes += (shapes.empty() ? "" : " and ") + printable_path(shape);
    fmt::print("  {} {}: {} pixels\n", what, shapes, pixels);
  };
  if (const auto& crop = comparison.crop)
    fmt::print("  of both, {} x {} pixels from x {}, y {}\n", crop->width, crop->height, crop->x,
               crop->y);
  if (const auto& ignored = comparison.ignored)
    print("equal by --ignore", ignored->of, ignored->pixels);
  if (!comparison.mask_of.empty() && comparison.mask_pixels)
    print("the mask is", comparison.mask_of, *comparison.mask_pixels);
}

/// A column of the table of metrics: values by the id that a metric has in it.
struct Column {
  const char* title;
  const records::Named<double>* values;
  Region region;
};

void print_metric_lines(const Comparison& comparison) {
  const auto& floor = comparison.reference_floor;
  std::vector<Column> columns{{"A and B", &comparison.metrics, Region::kWhole}};
  if (floor) columns.push_back({"C and B", &floor->metrics, Region::kWhole});
  if (comparison.highlight_pixels.value_or(0) > 0)
    columns.push_back({"highlight", &comparison.metrics, Region::kHighlight});
  if (comparison.mask_pixels) {
    columns.push_back({"in the mask", &comparison.metrics, Region::kMask});
    columns.push_back({"outside", &comparison.metrics, Region::kOutside});
  }
  fmt::print("  {:<20}", "");
  for (const Column& column : columns) fmt::print("{:>13}", column.title);
  fmt::print("\n");
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      if (metric->region != Region::kWhole) continue;
      const std::string id(output.id);
      std::string cells;
      bool any = false;
      for (const Column& column : columns) {
        const double* value =
            records::find(*column.values, id_in_region(*metric, output, column.region));
        any = any || (value && !std::isnan(*value));
        cells += fmt::format("{:>13}", value ? fmt::format("{:.6g}", *value) : "");
      }
      if (!any) continue;
      fmt::print("  {:<20}{}", id, cells);
      fmt::print("  {}{}\n", error_bar_text(comparison, id), output.meaning);
    }
  for (const NotMeasured& one : comparison.not_measured)
    if (find_metric(one.metric)->region == Region::kWhole)
      fmt::print("  {:<20}{:>13}  not measured: {}\n", one.metric, "-", one.because);
}

void print_limit_lines(const std::vector<LimitResult>& limits, std::string_view before) {
  for (const LimitResult& limit : limits)
    fmt::print("  {}{:<26}{:>14.6g}  {} {:g}\n", before, limit.metric, limit.value,
               std::isnan(limit.value)             ? "was NOT MEASURED; the limit is"
               : limit.pass                        ? "is within"
               : limit.standing == Standing::kOpen ? "MAY BE ON EITHER SIDE OF"
                                                   : "is OUTSIDE",
               limit.limit);
}

/// The short table leaves out regions, unless a figure has a default limit.
bool is_in_short_table(std::string_view id) {
  return find_metric(id)->region == Region::kWhole ||
         std::ranges::count(highlight_limits(), id, &MetricLimit::metric) > 0;
}

/// A line for each metric that some pairs lack, with the reason of the first of them.
void print_not_measured(const std::vector<PairReport>& pairs) {
  std::map<std::string_view, std::pair<std::size_t, std::string>> reasons;
  for (const PairReport& pair : pairs)
    if (pair.comparison)
      for (const NotMeasured& one : pair.comparison->not_measured)
        ++reasons.try_emplace(one.metric, 0, one.because).first->second.first;
  for (const auto& [id, why] : reasons)
    if (is_in_short_table(id))
      fmt::print("  {:<26}not measured in {} pairs: {}\n", id, why.first, why.second);
}

}  // namespace

void print_pair(const PairReport& pair, const PrintChoice& choice) {
  const Comparison& comparison = *pair.comparison;
  if (choice.quiet && is_pass(pair.verdict())) return;
  if (choice.quiet) {
    fmt::print("{}  {}\n", painted(verdict_name(pair.verdict()), weight_of(pair), choice.colour),
               why_not_pass(pair));
    return;
  }
  print_names(pair.a, pair.b, pair.c);
  if (const auto& display = comparison.viewing.display)
    fmt::print("shown by view {} of display {} in {}\n", printable(display->choice().view),
               printable(display->choice().display), printable_path(display->choice().config));
  fmt::print("\n");
  if (comparison.verdict == Verdict::kNonFinite)
    fmt::print("  {}; nothing was measured\n", why_not_pass(comparison, pair.a, pair.b));
  if (comparison.nonfinite.equal_allowed.value_or(0) > 0)
    fmt::print("  in {} pixels both have the same NaN or infinity, which counts as no difference\n",
               *comparison.nonfinite.equal_allowed);
  print_parts(comparison);
  if (comparison.type != LayerType::kColour)
    fmt::print("  compared as layers of type {}\n\n", layer_type_name(comparison.type));
  if (!comparison.finding.empty()) fmt::print("  {}\n\n", comparison.finding);
  if (const std::string sentence = highlight_sentence(comparison); !sentence.empty())
    fmt::print("  {}\n\n", sentence);
  print_exposures(comparison.viewing);
  print_noise(comparison);
  print_metric_lines(comparison);
  fmt::print("\n");
  if (comparison.verdict != Verdict::kNonFinite) {
    print_limit_lines(comparison.limits, "");
    print_limit_lines(comparison.warnings, "warning: ");
  }
  for (const std::string& sentence : sentences_on_highlights(comparison.highlights))
    fmt::print("  {}\n", sentence);
  for (const LimitResult& limit : comparison.limits)
    if (limit.more_samples && std::isfinite(*limit.more_samples))
      fmt::print("  about {:.3g} times the samples would tell about {}\n", *limit.more_samples,
                 limit.metric);
  for (const std::string& sentence : comparison.disagreement)
    fmt::print("  metrics disagree: {}\n", sentence);
  for (const std::string& sentence : comparison.blind_limits)
    fmt::print("  warning: {}\n", sentence);
  if (pair.layers) print_layers(*pair.layers, pair.a, pair.b);
  if (pair.sources) print_reading(pair);
  if (pair.references.size() > 1)
    fmt::print("  of {} acceptable references, b is the one that it fits best\n",
               pair.references.size());
  if (pair.known) fmt::print("  {}\n", printable_path(known_text(pair)));
  fmt::print("\nverdict: {}\n",
             painted(verdict_name(pair.verdict()), weight_of(pair), choice.colour));
}

void print_set(const SetReport& report, const PrintChoice& choice) {
  const auto line = [&](std::string_view what, std::optional<Problem::Weight> weight,
                        const std::string& name, const std::string& why) {
    fmt::print("  {}{}{}{}\n", painted(fmt::format("{:<11} ", what), weight, choice.colour),
               printable_path(name), why.empty() ? "" : ": ", printable_path(why));
  };
  const std::vector<Problem> found = problems(report);
  if (choice.quiet) {
    for (const Problem& one : found)
      if (one.weight != Problem::Weight::kNotice) line(one.what, one.weight, one.name, one.why);
    return;
  }
  print_names(report.a, report.b, report.c);
  fmt::print("\n");
  for (const Problem& one : found) line(one.what, one.weight, one.name, one.why);
  if (choice.verbose)
    for (const PairReport& pair : report.pairs)
      if (pair.comparison && is_pass(pair.verdict()))
        line(verdict_name(pair.verdict()), std::nullopt, pair.name,
             highlight_sentence(*pair.comparison));

  const std::vector<MetricSummary> summaries = summarise(report.pairs);
  if (!summaries.empty()) fmt::print("\n  {:<26}{:>14}{:>14}\n", "", "mean", "worst");
  for (const MetricSummary& metric : summaries)
    if (choice.verbose || is_in_short_table(metric.id))
      fmt::print("  {:<26}{:>14.6g}{:>14.6g}  {}\n", metric.id, metric.mean, metric.worst,
                 printable_path(metric.worst_at->name));
  print_not_measured(report.pairs);
  fmt::print("\n{}\n", counts_text(report));
  if (const SetNotCompared left = not_compared(report); left.pairs > 0)
    fmt::print("not compared, in {} of the pairs: {}\n", left.pairs, to_text(left.all));
  if (report.passed_over > 0)
    fmt::print("{} files are no pictures, or do not fit the pattern\n", report.passed_over);
}

}  // namespace lobelia::cli
