#include "compare/compare.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/pictures/image_values.hpp"
#include "base/system/scratch_memory.hpp"
#include "base/words/constants.hpp"
#include "base/words/text.hpp"
#include "compare/disagreement.hpp"
#include "compare/faults.hpp"
#include "compare/highlight_region.hpp"
#include "compare/highlights/words.hpp"
#include "compare/judge_limits.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/uncertainty/z_test.hpp"
#include "profile/require_same_size.hpp"

namespace lobelia {
namespace {

/// In ComparisonOptions::metrics: all that need not be requested.
constexpr std::string_view kDefaultMetrics = "default";

std::int64_t count_nonfinite_pixels(const Image& image) {
  const std::span<const float> values = image.values();
  std::int64_t count = 0;
  in_parts(image.pixel_count(), 3 * sizeof(float), [&](std::size_t begin, std::size_t end) {
    if (is_finite(values.subspan(3 * begin, 3 * (end - begin)))) return;
    for (std::size_t i = 3 * begin; i < 3 * end; i += 3)
      count += !std::isfinite(values[i]) || !std::isfinite(values[i + 1]) ||
               !std::isfinite(values[i + 2]);
  });
  return count;
}

void require_range(std::string_view what, double value, double min, double max) {
  if (!(value >= min && value <= max))
    throw Error(ExitCode::kUsage, "{} is {}; it must lie in [{}, {}]", what, value, min, max);
}

/// The input of the metric that the options lack; empty if they lack none.
std::string_view missing_input(const Metric& metric, const ComparisonOptions& options) {
  if (metric.needs == Needs::kTolerance && !options.tolerance) return "a tolerance";
  if (metric.needs == Needs::kHdrExposures && !options.viewing.hdr_exposures)
    return "a range of exposures";
  const bool by_mask = metric.region == Region::kMask || metric.region == Region::kOutside;
  if (by_mask && options.mask.empty() && options.mask_of.empty())
    return "a mask (--mask or --scene)";
  const bool of_highlight = metric.region == Region::kHighlight ||
                            metric.needs == Needs::kHighlight || metric.needs == Needs::kHighlights;
  if (of_highlight && !options.highlight) return "the highlight";
  if (metric.needs == Needs::kNoise && !options.noise) return "the noise of a picture";
  return {};
}

/// Whether the options ask for the metric, by its name or by a limit.
bool is_asked_for(const Metric& metric, const ComparisonOptions& options) {
  const auto is_in = [&](std::span<const MetricLimit> limits) {
    return std::ranges::any_of(limits, [&](const MetricLimit& limit) {
      return std::ranges::count(metric.outputs, limit.metric, &MetricOutput::id) > 0;
    });
  };
  if (is_in(options.limits) || is_in(options.warnings)) return true;
  if (options.default_limits &&
      (is_in(default_limits()) || (options.highlight && is_in(highlight_limits()))))
    return true;
  // Noise and tolerance are judged by limits that requested_limits() adds.
  if (metric.region == Region::kWhole && ((metric.needs == Needs::kNoise && options.noise) ||
                                          (metric.needs == Needs::kTolerance && options.tolerance)))
    return true;
  if (options.metrics.empty()) return !metric.on_request;
  return std::ranges::any_of(options.metrics, [&](const std::string& name) {
    return name == kDefaultMetrics ? !metric.on_request : is_named(metric, name);
  });
}

MetricList metrics_asked_for(const ComparisonOptions& options) {
  MetricList list;
  for (const Metric* metric : metrics())
    if (is_asked_for(*metric, options)) list.push_back(metric);
  return list;
}

/// Whether one of them needs the highlight.
bool need_highlight(const MetricList& list) {
  return std::ranges::any_of(list, [](const Metric* metric) {
    return metric->region == Region::kHighlight || metric->needs == Needs::kHighlight;
  });
}

/// Whether one of them judges each highlight by itself.
bool need_each_highlight(const MetricList& list) {
  return std::ranges::count(list, Needs::kHighlights, &Metric::needs) > 0;
}

/// Whether one of them looks at the pictures as shown.
bool need_display(const MetricList& list) {
  return std::ranges::any_of(
      list, [](const Metric* metric) { return metric->family != Family::kRadiance; });
}

records::Named<double> measure_all(const MetricList& list, const MetricInput& input) {
  MetricList measurable;
  std::ranges::copy_if(list, std::back_inserter(measurable),
                       [&](const Metric* metric) { return is_measurable(*metric, input); });
  const auto values = measure_metrics(measurable, input);
  records::Named<double> results;
  std::size_t measured = 0;
  for (const Metric* metric : list) {
    const bool is_measured = measured < measurable.size() && measurable[measured] == metric;
    if (!is_measured && !is_best_by_equality(*metric, input)) continue;
    for (std::size_t i = 0; i < metric->outputs.size(); ++i) {
      const MetricOutput& output = metric->outputs[i];
      if (is_measured || output.better != Better::kNeither)
        results.emplace_back(output.id, is_measured ? values[measured][i] : output.best);
    }
    measured += is_measured;
  }
  return results;
}

std::vector<NotMeasured> all_not_measured(const MetricList& list, const MetricInput& input) {
  std::vector<NotMeasured> result;
  for (const Metric* metric : list)
    if (const std::string why = why_not_measured(*metric, input); !why.empty())
      for (const MetricOutput& output : metric->outputs)
        if (output.better != Better::kNeither) result.push_back({std::string(output.id), why});
  return result;
}

NoiseOfPair noise_of_pair(const ComparisonOptions& options) {
  if (!options.noise) return {};
  const NoiseOptions& noise = *options.noise;
  return {noise.a ? &*noise.a : nullptr, noise.b ? &*noise.b : nullptr, judges_of(options).of_z};
}

records::Uncertainty uncertainty_of(const MetricInput& input, const ComparisonOptions& options) {
  const NoiseOptions& noise = *options.noise;
  const auto in_short = [](const PictureNoise* one) -> std::optional<records::PictureNoise> {
    if (!one) return std::nullopt;
    return records::PictureNoise{one->freedom, one->shared, one->layer, one->fireflies,
                                 one->has_heavy_tails()};
  };
  const int width = input.a.width(), height = input.a.height();
  return {.a = in_short(input.noise->a),
          .b = in_short(input.noise->b),
          .significance = noise.significance,
          .judges = judges_of(options).count(),
          .tests = count_of_tests(width, height),
          .each = level_of_single_values(width, height, input.noise->significance),
          .bootstraps = noise.bootstraps,
          .seed = noise.seed};
}

// Pictures with noise. A limit is on the figure that endless samples would give; the error bar says where that may
// lie. The limit holds if it holds for the whole bar, is broken if it is broken for the whole bar, and is otherwise
// open. Pictures are different if a limit is broken, the same if all hold, and otherwise undecided: neither a pass
// nor a difference, more samples are needed.
//
// One broken limit of many makes a difference, so the end of a bar near equal pictures is that of a family: all limits
// together are beyond it by chance in as many pairs as the significance says. The same needs every limit, so each is
// judged by its own far end: R. L. Berger, "Multiparameter Hypothesis Testing and Acceptance Sampling", Technometrics
// 24, 1982.

/// The limits that the options ask for:
///   limits        these limits;
///   a tolerance   no more pixels than it allows are beyond tolerance and noise together, and no region is. Without
///                 limits also: no more pixels are open, so that the same pictures surely lie within the tolerance.
///                 With limits the tolerance is for rounding, and the limits say how fine the answer has to be;
///   neither       nothing is beyond the noise. So pictures that are too noisy to find anything are undecided, not the
///                 same.
/// Without noise, a tolerance limits the outliers instead. The default limits come on top, unless they are left out.
/// Where noise leaves one of them open that was not asked for, it does not count.
std::vector<MetricLimit> requested_limits(const ComparisonOptions& options,
                                          const Comparison& measured) {
  std::vector<MetricLimit> limits = options.limits;
  const bool by_default = limits.empty() && !options.tolerance;
  const bool by_tolerance = limits.empty() && options.tolerance;
  const auto add = [&](MetricLimit limit) {
    const bool is_given =
        std::ranges::count(options.limits, limit.metric, &MetricLimit::metric) > 0;
    // Shares of the light may be off by the rounding of stored values.
    if (find_metric_output(limit.metric)->unit == Unit::kShare && measured.value("peak") > 0)
      limit.limit += options.rounding / measured.value("peak");
    // A tolerance allows a few pixels any difference.
    if (options.tolerance && limit.metric == "max_rel_peak") return;
    if (!is_given && measured.why_not_measured(limit.metric).empty()) limits.push_back(limit);
  };
  if (options.default_limits) {
    std::ranges::for_each(default_limits(), add);
    if (options.highlight) std::ranges::for_each(highlight_limits(), add);
  }
  const double allowed = options.tolerance ? double(options.tolerance->allowed_outliers) : 0;
  const std::string beyond = options.noise ? "z.beyond" : "outliers";
  if (options.tolerance || (options.noise && by_default)) limits.push_back({beyond, allowed});
  if (options.tolerance && !options.tolerance->edges.empty())
    limits.push_back({beyond + ".off_edge", 0});
  if (options.noise && (options.tolerance || by_default)) limits.push_back({"z.regions", 0});
  if (options.noise && by_tolerance) limits.push_back({kOpenPixels, allowed});
  return limits;
}

/// Whether a default limit on the metric stands, as none was given.
bool is_by_default(std::string_view metric, const ComparisonOptions& options) {
  const auto has = [&](std::span<const MetricLimit> limits) {
    return std::ranges::count(limits, metric, &MetricLimit::metric) > 0;
  };
  return !has(options.limits) && (has(default_limits()) || has(highlight_limits()));
}

Verdict verdict_of(std::span<const LimitResult> limits, bool noisy) {
  if (!noisy)
    return std::ranges::all_of(limits, &LimitResult::pass) ? Verdict::kPass : Verdict::kDiffers;
  if (std::ranges::count(limits, Standing::kBroken, &LimitResult::standing) > 0)
    return Verdict::kDifferent;
  const bool open = std::ranges::count(limits, Standing::kOpen, &LimitResult::standing) > 0;
  return open ? Verdict::kUndecided : Verdict::kSame;
}

}  // namespace

bool is_pass(Verdict verdict) { return verdict == Verdict::kPass || verdict == Verdict::kSame; }

double Comparison::value(std::string_view id) const {
  const double* found = records::find(metrics, id);
  return found ? *found : kNaN;
}

std::string_view Comparison::why_not_measured(std::string_view id) const {
  for (const NotMeasured& one : not_measured)
    if (one.metric == id) return one.because;
  return {};
}

void check_options(const ComparisonOptions& options) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  require_range("the exposure in stops", options.viewing.exposure_stops, -kMaxExposureStops,
                kMaxExposureStops);
  require_range("pixels per degree", options.viewing.pixels_per_degree, kMinPixelsPerDegree,
                kMaxPixelsPerDegree);
  if (const auto& range = options.viewing.hdr_exposures) {
    require_range("the first exposure", range->start_stops, -kMaxExposureStops, kMaxExposureStops);
    require_range("the last exposure", range->stop_stops, range->start_stops, kMaxExposureStops);
    require_range("the number of exposures", range->count, 2, kMaxHdrExposures);
  }
  const std::vector<std::string_view> names = limit_names(true);
  const auto check_name = [&](const std::string& name) {
    const bool is_known =
        name == kDefaultMetrics || find_metric(name) ||
        std::ranges::any_of(metrics(), [&](const Metric* m) { return is_named(*m, name); });
    if (!is_known)
      throw Error(ExitCode::kUsage,
                  "no metric '{}'{}; there are {}, families, regions, default and all",
                  printable(name), did_you_mean(name, names), join(limit_names(false)));
  };
  const auto check_limit = [&](const MetricLimit& limit) {
    const MetricOutput* output = find_metric_output(limit.metric);
    if (!output || output->better == Better::kNeither)
      throw Error(ExitCode::kUsage, "no metric '{}' to set a limit on{}; there are {}",
                  printable(limit.metric), did_you_mean(limit.metric, names),
                  join(limit_names(false)));
    if (const std::string_view missing = missing_input(*find_metric(limit.metric), options);
        !missing.empty())
      throw Error(ExitCode::kUsage, "a limit on '{}' needs {}", limit.metric, missing);
    if (limit.metric == "outliers.off_edge" &&
        (!options.tolerance || options.tolerance->edges.empty()))
      throw Error(ExitCode::kUsage,
                  "a limit on 'outliers.off_edge' needs a tolerance and a scene that has edges");
    if (const std::string problem = limit_problem(*output, limit.limit); !problem.empty())
      throw Error(ExitCode::kUsage, problem);
  };
  for (const std::string& name : options.metrics) check_name(name);
  for (const MetricLimit& limit : options.limits) check_limit(limit);
  for (const MetricLimit& limit : options.warnings) check_limit(limit);
  if (options.tolerance) {
    require_range("the relative tolerance", options.tolerance->relative, 0, kLargest);
    require_range("the tolerance as a share of the peak", options.tolerance->of_peak, 0, kLargest);
    require_range("the number of allowed outliers", double(options.tolerance->allowed_outliers), 0,
                  double(kMaxImagePixels));
  }
  if (options.noise) {
    require_range("the significance", options.noise->significance, kLeastSignificance,
                  kMostSignificance);
    require_range("the number of bootstraps", options.noise->bootstraps, kFewestBootstraps,
                  kMostBootstraps);
  }
}

ReferenceFloor measure_reference_floor(const Image& c, const Image& b,
                                       const ComparisonOptions& options) {
  // The known noise is that of a.
  ComparisonOptions plain = options;
  plain.noise.reset();
  plain.limits.clear();
  plain.warnings.clear();
  Comparison measured = compare(c, b, plain);
  return {"", measured.nonfinite.a, std::move(measured.metrics)};
}

Comparison compare(const Image& a, const Image& b, const ComparisonOptions& options) {
  check_options(options);
  require_same_size(a, b);
  const auto require_pixels = [&](std::string_view what, std::size_t count) {
    if (count != 0 && count != a.pixel_count())
      throw Error(ExitCode::kInput, "the pictures have {} pixels, the {} {}", a.pixel_count(), what,
                  count);
  };
  if (options.tolerance) require_pixels("scene", options.tolerance->edges.size());
  require_pixels("mask", options.mask.size());
  require_pixels("surfaces", options.surfaces.size());
  const NoiseOfPair noise = noise_of_pair(options);
  for (const PictureNoise* one : {noise.a, noise.b})
    if (one) require_same_size(a, one->cautious);

  Comparison result;
  result.viewing = options.viewing;
  result.tolerance = options.tolerance;
  const auto count_of = [](const PixelFlags& pixels) {
    std::int64_t count = 0;
    in_parts(pixels.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (; begin < end; ++begin) count += pixels[begin] != 0;
    });
    return count;
  };
  if (!options.mask.empty()) result.mask_pixels = count_of(options.mask);
  result.mask_of = options.mask_of;
  if (!options.ignored.empty())
    result.ignored = records::Mask{count_of(options.ignored), options.ignored_of};
  result.crop = options.crop;
  oneapi::tbb::parallel_invoke([&] { result.nonfinite.a = count_nonfinite_pixels(a); },
                               [&] { result.nonfinite.b = count_nonfinite_pixels(b); });
  const bool finite = result.nonfinite.a == 0 && result.nonfinite.b == 0;
  ErrorBars bars_of_limits;
  if (!finite) {
    result.nonfinite.first = {first_nonfinite(a), first_nonfinite(b)};
  } else {
    const MetricList list = metrics_asked_for(options);
    // Limits that hardly see the highlight draw a warning.
    const bool find_highlight =
        options.highlight && (need_highlight(list) || !options.limits.empty());
    const bool choose_exposures = need_display(list) && options.viewing.automatic;
    const Peaks peaks = find_highlight || choose_exposures ? peaks_of(a, b) : Peaks{};
    const bool find_each = options.highlight && need_each_highlight(list);
    const HighlightNoise may_differ{options.noise ? &noise : nullptr, options.rounding};
    std::vector<LocalHighlight> highlights;
    if (find_each || (choose_exposures && needs_exposures(peaks)))
      highlights = find_highlights(b, options.surfaces, may_differ);
    if (need_display(list)) result.viewing = with_exposures(options.viewing, peaks, b, highlights);
    if (find_each)
      add_highlights_of_a(a, b, options.surfaces, may_differ, highlights);
    else
      highlights.clear();
    const std::vector<JudgedHighlight> judged = judge_highlights(a, b, highlights);
    result.highlights = highlights_record(judged);
    Viewing viewing = result.viewing;
    if (!need_display(list)) viewing.display = nullptr;
    PixelFlags highlight;
    if (find_highlight) {
      highlight = highlight_region(a, b, peaks, options.surfaces);
      result.highlight_pixels = count_of(highlight);
      result.highlight_share = double(*result.highlight_pixels) / double(a.pixel_count());
    }
    const MetricInput input{a,
                            b,
                            as_shown(a, viewing),
                            as_shown(b, viewing),
                            viewing.pixels_per_degree,
                            options.tolerance ? &*options.tolerance : nullptr,
                            viewing.hdr_exposures ? &*viewing.hdr_exposures : nullptr,
                            options.mask,
                            options.noise ? &noise : nullptr,
                            highlight,
                            judged,
                            further_as_shown(a, b, viewing),
                            have_equal_values(a, b),
                            options.layer};
    result.metrics = measure_all(list, input);
    result.not_measured = all_not_measured(list, input);
    if (options.noise) {
      result.uncertainty = uncertainty_of(input, options);
      const NoisyFigures figures(
          list, input, viewing, {options.noise->bootstraps, options.noise->seed, options.surfaces});
      result.error_bars = figures.bars();
      bars_of_limits = figures.bars_of_limits(judges_of(options).of_figure);
    }
  }
  const bool noisy = options.noise.has_value();
  result.limits =
      judge(requested_limits(options, result), result, noisy ? &bars_of_limits : nullptr);
  if (noisy && (!options.limits.empty() || options.tolerance))
    std::erase_if(result.limits, [&](const LimitResult& limit) {
      return limit.standing == Standing::kOpen && is_by_default(limit.metric, options);
    });
  result.warnings = judge(options.warnings, result);
  result.disagreement = disagreements(result.limits);
  if (result.highlight_pixels.value_or(0) > 0)
    result.blind_limits = blind_limits(judge(options.limits, result), result.highlight_share);
  result.verdict = finite ? verdict_of(result.limits, noisy) : Verdict::kNonFinite;
  // Only of colours: nobody clips or encodes a depth.
  if (finite && !options.layer && !is_pass(result.verdict)) result.faults = find_faults(a, b);
  return result;
}

}  // namespace lobelia
