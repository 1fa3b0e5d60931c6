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

}  // namespace lobelia::search
