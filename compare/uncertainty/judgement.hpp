// A verdict on pictures with noise.
//
// A limit is on the figure that endless samples would give, of which an error bar says where it may lie. The limit
//   holds        if it holds for all of the bar,
//   is broken    if it is broken for all of the bar,
//   is open      otherwise.
// Pictures are different if a limit is broken, the same if all hold, and else undecided: more samples are needed,
// which is neither a pass nor a difference. What is asked:
//   by limits            those limits;
//   by a tolerance       that no more pixels than it allows are found beyond tolerance and noise together, and no
//                        region; and if there are no limits, that no more pixels are open: so the same is
//                        said of pixels that surely lie within it. With limits the tolerance is what
//                        rounding may do, and they say how fine the answer has to be;
//   by neither           that nothing is found beyond the noise, and the default limits: so pictures so
//                        noisy that nothing could be found are not the same, but undecided.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "compare/compare.hpp"

namespace lobelia {

/// The limits that options with noise ask for, in words above.
std::vector<MetricLimit> asked_limits(const ComparisonOptions& options);

/// How a limit stands, by its error bar; without one by its value. Not open only if the value was measured.
Standing standing_of(const MetricLimit& limit, double value, const ErrorBar* bar);

/// How many times the samples would decide an open limit, about: bar and noise floor shrink with their root, and
/// the figure with the floor. Infinite where that cannot be said, or they are more than a million.
double more_samples(const MetricLimit& limit, double value, const ErrorBar* bar);

Verdict verdict_of(std::span<const LimitResult> limits);

}  // namespace lobelia
