// Limits and what was measured: which hold.
#pragma once

#include "compare/compare.hpp"

namespace lobelia {

/// Pixels that noise leaves undecided. Over its limit this count is open, never broken.
inline constexpr char kOpenPixels[] = "z.open";

/// The limits that can call pictures with noise different, and the chance of a false difference that each of them has.
/// All limits of z are one test. It finds the most, so half of the significance is its own, and the figures share the
/// other half. That is Bonferroni's correction with weights: together they have the significance, however they depend on
/// each other. Holm's later steps would change no verdict: one broken limit is enough.
struct Judges {
  bool z = false;
  int figures = 0;
  double of_z = 0, of_figure = 0;

  int count() const { return figures + z; }
};
/// The options have noise.
Judges judges_of(const ComparisonOptions& options);

/// `bars`: the error bars of pictures with noise, null for others.
std::vector<LimitResult> judge(std::span<const MetricLimit> limits, const Comparison& measured,
                               const ErrorBars* bars = nullptr);

}  // namespace lobelia
