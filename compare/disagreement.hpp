// Clear contradictions between metrics of different families.
#pragma once

#include "compare/compare.hpp"

namespace lobelia {

/// How much of its limit a value takes up. Equal pictures have 0; up to 1 passes; infinite if the limit accepts only
/// equality.
///   lower is better:       value / limit
///   nearer to 0 is better: |value| / limit
///   higher is better:      (best - value) / (best - limit); for decibels, which have no finite best, the
///                          ratio of the errors, 10^((limit - value) / 20)
double share_of_limit(const MetricOutput& output, double value, double limit);

/// A wide margin is ten times a limit, or a tenth.
inline constexpr double kWideMargin = 10;

/// A sentence for each pair of limits on metrics of different families of which one passes and the other fails, one
/// of them by a wide margin: the failing one takes up more than kWideMargin of its limit, or the passing one less than
/// 1 / kWideMargin of its own. Empty if nothing was measured.
std::vector<std::string> disagreements(std::span<const LimitResult> limits);

/// A highlight of a smaller share of the picture hardly moves a mean over all pixels.
inline constexpr double kSmallHighlight = 0.02;

/// Sentences on limits that cannot see a highlight of this share of the picture: percentiles and means over the whole
/// picture. And on metrics with two limits, of which the stricter decides.
std::vector<std::string> blind_limits(std::span<const LimitResult> limits, double highlight_share);

}  // namespace lobelia
