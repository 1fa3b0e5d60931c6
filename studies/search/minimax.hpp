// The lobe of a shape with the least largest error against cos^n, over all angles and a range of exponents, and the
// proof that none of that shape is better.
#pragma once

#include <vector>

#include "studies/search/shape.hpp"

namespace lobelia::search {

/// A point where the best lobe has its largest error.
struct Touch {
  double t, v;    ///< n s and 1/n
  double error;   ///< value - cos^n, with its sign
  double weight;  ///< > 0; they sum to 1
};

/// The best lobe of a shape.
///
/// The touches are a certificate. Their weights, with the signs of the errors, annihilate every t^j v^r of the shape:
/// so the sum of weight * sign * y is the same for all coefficients, and where the errors were all below `lower_bound`
/// it would be another. For one exponent that is Chebyshev's alternation.
struct Minimax {
  Lobe lobe;
  double error = 0;        ///< largest seen
  double lower_bound = 0;  ///< no lobe of the shape has less
  std::vector<Touch> touches;
};

inline constexpr double kLeastSlope = 1e-4;
/// Coefficients have 10 digits, those that are printed. y falls at least by `slope` for each 10 of t, as far as that was
/// looked at. No coefficients if no lobe is within half of the peak, or the solver fails.
Minimax minimax(const Shape& shape, const Range& range, double slope = kLeastSlope);

/// The least error that the certificate leaves possible, from the touches alone.
double lower_bound_of(const Shape& shape, const std::vector<Touch>& touches);

/// A bound of a lobe's error for every angle and every exponent of a range, not only where somebody looked.
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
