// Limits that cannot see the highlight.
#pragma once

#include "compare/compare.hpp"

namespace lobelia {

/// A highlight of a smaller share of the picture hardly moves a mean over all pixels.
inline constexpr double kSmallHighlight = 0.02;

/// Sentences on limits that cannot see a highlight of this share of the picture: percentiles and means over the whole
/// picture. And on metrics with two limits, of which the stricter decides.
std::vector<std::string> blind_limits(std::span<const LimitResult> limits, double highlight_share);

}  // namespace lobelia
