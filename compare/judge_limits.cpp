#include "compare/judge_limits.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/words/constants.hpp"
#include "compare/metrics/catalogue.hpp"

namespace lobelia {
namespace {

/// How a limit stands by its error bar; without one by its value. A value that was not measured is open.
std::string_view standing_of(const MetricLimit& limit, double value, const ErrorBar* bar) {
  if (limit.metric == kOpenPixels) return value <= limit.limit ? Standing::kHolds : Standing::kOpen;
  const MetricOutput* output = find_metric_output(limit.metric);
  const double low = bar ? bar->low : value, high = bar ? bar->high : value;
  if (!output || std::isnan(value) || std::isnan(low) || std::isnan(high)) return Standing::kOpen;
  const bool low_holds = is_within(*output, low, limit.limit);
  const bool high_holds = is_within(*output, high, limit.limit);
  if (low_holds && high_holds) return Standing::kHolds;
  // A signed value may be 0 between two ends that are both too far from 0.
  const bool around_zero = output->better == Better::kNearZero && low < 0 && high > 0;
  return low_holds || high_holds || around_zero ? Standing::kOpen : Standing::kBroken;
}

/// The factor of extra samples that would decide an open limit, roughly: bar and noise floor shrink with its root, and
/// the figure with the floor. Infinite if unknown or over a million.
double more_samples(const MetricLimit& limit, double value, const ErrorBar* bar) {
  const MetricOutput* output = find_metric_output(limit.metric);
  if (!output || !bar) return kInfinity;
  const bool is_signed = output->better == Better::kNearZero;
  const double now = as_distance(*output, value), floor = as_distance(*output, bar->noise_floor),
               floor_most = as_distance(*output, bar->noise_floor_most),
               spread =
                   std::max(as_distance(*output, bar->low), as_distance(*output, bar->high)) - now;
  // As for rmse: squares add up.
  const double endless = is_signed ? now : std::sqrt(std::max(0.0, now * now - floor * floor));
  constexpr double kStep = 1.1, kMost = 1e6;
  for (double times = kStep; times < kMost; times *= kStep) {
    const double shrunk = 1 / std::sqrt(times);
    const double then = is_signed ? now : std::hypot(endless, floor * shrunk);
    const double near =
        is_signed ? then - spread * shrunk : std::max(0.0, then - floor_most * shrunk);
    ErrorBar bar_then;
    bar_then.low = from_distance(*output, near);
    bar_then.high = from_distance(*output, then + spread * shrunk);
    if (standing_of(limit, value, &bar_then) != Standing::kOpen) return times;
  }
  return kInfinity;
}

}  // namespace

Judges judges_of(const ComparisonOptions& options) {
  std::set<std::string_view> figures;
  Judges judges;
  const auto add = [&](std::span<const MetricLimit> limits) {
    for (const MetricLimit& limit : limits)
      if (find_metric(limit.metric)->needs == Needs::kNoise)
        judges.z = true;
      else
        figures.insert(limit.metric);
  };
  add(options.limits);
  if (options.default_limits) {
    add(default_limits());
    if (options.highlight) add(highlight_limits());
  }
  if (options.limits.empty() || options.tolerance) judges.z = true;
  judges.figures = int(figures.size());
  const double all = options.noise->significance;
  const bool both = judges.z && judges.figures > 0;
  judges.of_z = both ? all / 2 : all;
  judges.of_figure = (both ? all / 2 : all) / std::max(1, judges.figures);
  return judges;
}

std::vector<LimitResult> judge(std::span<const MetricLimit> limits, const Comparison& measured,
                               const ErrorBars* bars) {
  std::vector<LimitResult> results;
  for (const auto& [metric, limit] : limits) {
    const double value = measured.value(metric);
    const MetricOutput* output = find_metric_output(metric);
    LimitResult& result = results.emplace_back(
        LimitResult{metric, limit, value, output && is_within(*output, value, limit), {}, {}});
    if (!bars) continue;
    const ErrorBar* bar = records::find(*bars, metric);
    result.standing = standing_of({metric, limit}, value, bar);
    result.pass = result.standing == Standing::kHolds;
    if (result.standing == Standing::kOpen)
      result.more_samples = more_samples({metric, limit}, value, bar);
  }
  return results;
}

}  // namespace lobelia
