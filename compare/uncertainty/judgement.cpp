#include "compare/uncertainty/judgement.hpp"

#include <algorithm>
#include <cmath>

#include "compare/metrics/catalogue.hpp"
#include "core/constants.hpp"

namespace lobelia {
namespace {

constexpr std::string_view kOpen = "z.open";

}  // namespace

std::vector<MetricLimit> asked_limits(const ComparisonOptions& options) {
  std::vector<MetricLimit> limits = options.limits;
  const bool by_limits = !limits.empty();
  if (!by_limits && !options.tolerance)
    limits.assign(default_limits().begin(), default_limits().end());
  if (by_limits && !options.tolerance) return limits;
  const double allowed = options.tolerance ? double(options.tolerance->allowed_outliers) : 0;
  limits.push_back({"z.beyond", allowed});
  if (options.tolerance && !options.tolerance->edges.empty())
    limits.push_back({"z.beyond.off_edge", 0});
  limits.push_back({"z.regions", 0});
  if (!by_limits && options.tolerance) limits.push_back({std::string(kOpen), allowed});
  return limits;
}

Standing standing_of(const MetricLimit& limit, double value, const ErrorBar* bar) {
  if (limit.metric == kOpen) return value <= limit.limit ? Standing::kHolds : Standing::kOpen;
  const MetricOutput* output = find_metric_output(limit.metric);
  const double low = bar ? bar->low : value, high = bar ? bar->high : value;
  if (!output || std::isnan(value) || std::isnan(low) || std::isnan(high)) return Standing::kOpen;
  const bool low_holds = is_within(*output, low, limit.limit);
  const bool high_holds = is_within(*output, high, limit.limit);
  if (low_holds && high_holds) return Standing::kHolds;
  // What may be of either sign may be 0 between two ends that are both too far from it.
  const bool around_zero = output->better == Better::kNearZero && low < 0 && high > 0;
  return low_holds || high_holds || around_zero ? Standing::kOpen : Standing::kBroken;
}

double more_samples(const MetricLimit& limit, double value, const ErrorBar* bar) {
  const MetricOutput* output = find_metric_output(limit.metric);
  if (!output || !bar) return kInfinity;
  const bool is_signed = output->better == Better::kNearZero;
  const double now = as_distance(*output, value), floor = as_distance(*output, bar->noise_floor),
               floor_most = as_distance(*output, bar->noise_floor_most),
               spread =
                   std::max(as_distance(*output, bar->low), as_distance(*output, bar->high)) - now;
  // As of rmse, whose squares add up.
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

Verdict verdict_of(std::span<const LimitResult> limits) {
  const auto any = [&](Standing standing) {
    return std::ranges::any_of(
        limits, [&](const LimitResult& limit) { return limit.standing == standing; });
  };
  if (any(Standing::kBroken)) return Verdict::kDifferent;
  return any(Standing::kOpen) ? Verdict::kUndecided : Verdict::kSame;
}

}  // namespace lobelia
