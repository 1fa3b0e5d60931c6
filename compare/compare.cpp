#include "compare/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "compare/disagreement.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/require_same_size.hpp"
#include "compare/uncertainty/critical.hpp"
#include "compare/uncertainty/judgement.hpp"
#include "compare/uncertainty/z_test.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia {
namespace {

constexpr std::string_view kOutliers = "outliers";
constexpr std::string_view kOutliersOffEdge = "outliers.off_edge";

std::int64_t count_nonfinite_pixels(const Image& image) {
  const std::span<const float> values = image.values();
  std::int64_t count = 0;
  for (std::size_t i = 0; i < values.size(); i += 3)
    count +=
        !std::isfinite(values[i]) || !std::isfinite(values[i + 1]) || !std::isfinite(values[i + 2]);
  return count;
}

void require_range(std::string_view what, double value, double min, double max) {
  if (!(value >= min && value <= max))
    throw Error(ExitCode::kUsage,
                fmt::format("{} is {}; it must lie in [{}, {}]", what, value, min, max));
}

/// The input that an option must provide for the metric; empty if it has all.
std::string_view what_is_missing(const Metric& metric, const ComparisonOptions& options) {
  if (metric.needs == Needs::kTolerance && !options.tolerance) return "a tolerance";
  if (metric.needs == Needs::kHdrExposures && !options.viewing.hdr_exposures)
    return "a range of exposures";
  if (metric.needs == Needs::kMask && options.mask.empty()) return "a mask";
  if (metric.needs == Needs::kNoise && !options.noise) return "the noise of a picture";
  return {};
}

std::vector<MetricValue> measure_all(const MetricInput& input) {
  std::vector<MetricValue> results;
  std::vector<double> values;
  for (const Metric* metric : metrics()) {
    if (!is_measurable(*metric, input)) continue;
    values.assign(metric->outputs.size(), 0.0);
    metric->measure(input, values);
    for (std::size_t i = 0; i < values.size(); ++i)
      results.push_back({metric->outputs[i].id, metric->outputs[i].meaning, values[i]});
  }
  return results;
}

std::vector<NotMeasured> all_not_measured(const MetricInput& input) {
  std::vector<NotMeasured> result;
  for (const Metric* metric : metrics())
    if (const std::string why = why_not_measured(*metric, input); !why.empty())
      for (const MetricOutput& output : metric->outputs)
        if (output.better != Better::kNeither) result.push_back({std::string(output.id), why});
  return result;
}

std::vector<LimitResult> results_of(std::span<const MetricLimit> limits,
                                    const Comparison& measured) {
  std::vector<LimitResult> results;
  for (const MetricLimit& limit : limits) {
    const double value = measured.value(limit.metric);
    const MetricOutput* output = find_metric_output(limit.metric);
    results.push_back(
        {limit.metric, limit.limit, value, output && is_within(*output, value, limit.limit)});
  }
  return results;
}

NoiseOfPair noise_of_pair(const ComparisonOptions& options) {
  if (!options.noise) return {};
  const auto& [a, b, significance, bootstraps, seed] = *options.noise;
  return {a ? &*a : nullptr, b ? &*b : nullptr, significance};
}

records::Uncertainty uncertainty_of(const MetricInput& input, const NoiseOptions& noise) {
  const auto in_short = [](const PictureNoise* one) -> std::optional<records::PictureNoise> {
    if (!one) return std::nullopt;
    return records::PictureNoise{one->freedom, one->shared};
  };
  const double tests = count_of_tests(input.a.width(), input.a.height());
  return {.a = in_short(input.noise->a),
          .b = in_short(input.noise->b),
          .significance = noise.significance,
          .tests = tests,
          .each = sidak(noise.significance, tests),
          .bootstraps = noise.bootstraps,
          .seed = noise.seed};
}

/// Fills in limits and verdict.
void judge_noisy(const ComparisonOptions& options, Comparison& result) {
  for (const MetricLimit& limit : asked_limits(options)) {
    const double value = result.value(limit.metric);
    const ErrorBar* bar = records::find(result.error_bars, limit.metric);
    const Standing standing = standing_of(limit, value, bar);
    result.limits.push_back({limit.metric, limit.limit, value, standing == Standing::kHolds,
                             standing,
                             standing == Standing::kOpen ? more_samples(limit, value, bar) : 0});
  }
  result.warnings = results_of(options.warnings, result);
  result.disagreement = disagreements(result.limits);
  result.verdict = result.uncertainty ? verdict_of(result.limits) : Verdict::kNonFinite;
}

}  // namespace

std::span<const MetricLimit> default_limits() {
  static const std::array<MetricLimit, 3> limits{{
      // Engines that share the formula differ by 5e-4 of the peak where one writes half floats and
      // by 1e-5 where not; a wrong normalisation is off by 3 % and more.
      {"max_rel_peak", 0.01},
      // One step of an 8-bit display, 128 to 129 over the whole picture, has a FLIP of 0.03.
      {"flip.ldr.mean", 0.01},
      // 1 is about one just noticeable difference; so it is for all but one pixel in twenty, which
      // leaves the silhouette, where engines sample the edge differently, to max_rel_peak.
      {"ciede2000.p95", 1.0},
  }};
  return limits;
}

bool is_pass(Verdict verdict) { return verdict == Verdict::kPass || verdict == Verdict::kSame; }

double Comparison::value(std::string_view id) const {
  const auto found = std::ranges::find(metrics, id, &MetricValue::id);
  return found == metrics.end() ? std::numeric_limits<double>::quiet_NaN() : found->value;
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
  const std::vector<std::string_view> names = limit_names();
  const auto check_limit = [&](const MetricLimit& limit) {
    const MetricOutput* output = find_metric_output(limit.metric);
    if (!output || output->better == Better::kNeither)
      throw Error(ExitCode::kUsage, fmt::format("no metric '{}' to set a limit on{}; there are {}",
                                                printable(limit.metric),
                                                did_you_mean(limit.metric, names), join(names)));
    if (const std::string_view missing = what_is_missing(*find_metric(limit.metric), options);
        !missing.empty())
      throw Error(ExitCode::kUsage, fmt::format("a limit on '{}' needs {}", limit.metric, missing));
    if (limit.metric == kOutliersOffEdge &&
        (!options.tolerance || options.tolerance->edges.empty()))
      throw Error(ExitCode::kUsage,
                  "a limit on 'outliers.off_edge' needs a tolerance and a scene that has edges");
    const double least = output->better == Better::kHigher ? -kLargest : 0;
    require_range(fmt::format("the limit on {}", limit.metric), limit.limit, least, kLargest);
  };
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
  // What is known of the noise is that of a.
  ComparisonOptions plain = options;
  plain.noise.reset();
  plain.limits.clear();
  plain.warnings.clear();
  Comparison measured = compare(c, b, plain);
  return {measured.nonfinite_a, std::move(measured.metrics)};
}

Comparison compare(const Image& a, const Image& b, const ComparisonOptions& options) {
  check_options(options);
  require_same_size(a, b);
  const auto require_pixels = [&](std::string_view what, std::size_t count) {
    if (count != 0 && count != a.pixel_count())
      throw Error(ExitCode::kInput, fmt::format("the pictures have {} pixels, the {} {}",
                                                a.pixel_count(), what, count));
  };
  if (options.tolerance) require_pixels("scene", options.tolerance->edges.size());
  require_pixels("mask", options.mask.size());
  const NoiseOfPair noise = noise_of_pair(options);
  for (const PictureNoise* one : {noise.a, noise.b})
    if (one) require_same_size(a, one->cautious);

  Comparison result;
  result.viewing = options.viewing;
  result.tolerance = options.tolerance;
  if (!options.mask.empty())
    result.mask_pixels =
        std::ranges::count_if(options.mask, [](auto inside) { return inside != 0; });
  result.nonfinite_a = count_nonfinite_pixels(a);
  result.nonfinite_b = count_nonfinite_pixels(b);
  result.first_nonfinite_a = first_nonfinite(a);
  result.first_nonfinite_b = first_nonfinite(b);
  const bool finite = result.nonfinite_a == 0 && result.nonfinite_b == 0;
  if (finite) {
    const MetricInput input{
        a,
        b,
        as_shown(a, options.viewing),
        as_shown(b, options.viewing),
        options.viewing.pixels_per_degree,
        options.tolerance ? &*options.tolerance : nullptr,
        options.viewing.hdr_exposures ? &*options.viewing.hdr_exposures : nullptr,
        options.mask,
        options.noise ? &noise : nullptr};
    result.metrics = measure_all(input);
    result.not_measured = all_not_measured(input);
    if (options.noise) {
      result.uncertainty = uncertainty_of(input, *options.noise);
      result.error_bars =
          error_bars(input, options.viewing, options.noise->bootstraps, options.noise->seed);
    }
  }
  if (options.noise) {
    judge_noisy(options, result);
    return result;
  }

  std::vector<MetricLimit> limits = options.limits;
  if (options.tolerance)
    limits.push_back({std::string(kOutliers), double(options.tolerance->allowed_outliers)});
  if (options.tolerance && !options.tolerance->edges.empty())
    limits.push_back({std::string(kOutliersOffEdge), 0});
  if (limits.empty()) limits.assign(default_limits().begin(), default_limits().end());
  result.limits = results_of(limits, result);
  result.warnings = results_of(options.warnings, result);
  const bool pass = std::ranges::all_of(result.limits, &LimitResult::pass);
  result.disagreement = disagreements(result.limits);
  result.verdict = !finite ? Verdict::kNonFinite : pass ? Verdict::kPass : Verdict::kDiffers;
  return result;
}

DisplayImage difference_picture(const Image& a, const Image& b, double white_at) {
  require_same_size(a, b);
  DisplayImage picture{a.width(), a.height(), std::vector<std::uint8_t>(3 * a.pixel_count())};
  const std::span<const float> va = a.values(), vb = b.values();
  for (std::size_t i = 0; i < va.size(); i += 3) {
    bool finite = true;
    for (std::size_t j = i; j < i + 3; ++j) {
      const double difference = std::abs(double(va[j]) - double(vb[j]));
      finite = finite && std::isfinite(difference);
      if (finite && difference > 0)
        picture.rgb[j] = difference < white_at
                             ? std::uint8_t(std::lround(255 * difference / white_at))
                             : std::uint8_t{255};
    }
    if (!finite) {
      picture.rgb[i] = picture.rgb[i + 2] = 255;
      picture.rgb[i + 1] = 0;
    }
  }
  return picture;
}

}  // namespace lobelia
