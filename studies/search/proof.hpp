// A bound of a lobe's error that holds for every angle and every exponent of a range, not only where somebody looked.
#pragma once

#include "studies/search/shape.hpp"

namespace lobelia::search {

struct Proof {
  /// |value - cos^n| is nowhere more, s from 0 to 1 and n over the range; if `decreases`.
  double bound = 0;
  double seen = 0;  ///< the largest error found; within `kSlack` of the bound, or both below 1e-7
  bool decreases =
      false;       ///< y falls wherever the value is not 0: the lobe never rises. False too if
                   ///< the proof would take too long
  long boxes = 0;  ///< of s and n that were looked at
};
/// The relative slack that the proof may add to the largest error.
inline constexpr double kSlack = 5e-3;

/// By branch and bound over boxes of (t, v), in interval arithmetic with outward rounding, to second order.
Proof prove(const Lobe& lobe, const Range& range);

}  // namespace lobelia::search
