// Where metrics of different families say opposite things, and clearly.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/compare.hpp"

namespace lobelia {

/// How much of its limit a value takes up: 0 is equal pictures, up to 1 passes, infinite where nothing
/// but equality would have passed.
///   lower is better:       value / limit
///   nearer to 0 is better: |value| / limit
///   higher is better:      (best - value) / (best - limit); in decibels, whose best is infinite, the
///                          ratio of the errors, 10^((limit - value) / 20)
double share_of_limit(const MetricOutput& output, double value, double limit);

/// Wide of a limit: ten times it, or a tenth.
inline constexpr double kWideMargin = 10;

/// A sentence for each pair of limits on metrics of different families of which one passes and the other
/// fails, and one of the two by a wide margin: the one that fails takes up more than kWideMargin times
/// its limit, or the one that passes less than 1 / kWideMargin of its own. Empty where nothing was measured.
std::vector<std::string> disagreements(std::span<const LimitResult> limits);

}  // namespace lobelia
