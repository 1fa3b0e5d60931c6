// Limits and what was measured: which hold.
#pragma once

#include "compare/compare.hpp"

namespace lobelia {

/// Pixels that noise leaves undecided. Over its limit this count is open, never broken.
inline constexpr char kOpenPixels[] = "z.open";

/// The number of limits that can call pictures with noise different. All limits of z are one test.
int count_of_judges(const ComparisonOptions& options);

/// The chance of a false difference that each of them has. With Bonferroni's correction they have the significance
/// together, however they depend on each other. Holm's later steps would change no verdict: one broken limit is enough.
double significance_of_each(const ComparisonOptions& options);

/// `bars`: the error bars of pictures with noise, null for others.
std::vector<LimitResult> judge(std::span<const MetricLimit> limits, const Comparison& measured,
                               const ErrorBars* bars = nullptr);

}  // namespace lobelia
