// The few functions that lobes and models are written in, for double. renderer/kernels/lanes-inl.hpp
// has the same for a SIMD register, so that each formula stands once and serves both.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace lobelia {

/// `value` where a < b, else 0, even where `value` is NaN.
inline double where_less(double a, double b, double value) { return a < b ? value : 0.0; }

/// e^x for x <= 0; 0 where that would be no normal number, whose arithmetic can take a hundred times
/// as long.
inline double exp_or_zero(double x) {
  return x >= std::log(std::numeric_limits<double>::min()) ? std::exp(x) : 0.0;
}

/// ln(1 - s) for s in [0, 1). From s itself: 1 - s would lose the digits of a small s, which a large
/// n multiplies (at n = 1e6 none would be left in float32). Anything finite for other s.
inline double log_one_minus(double s) { return s < 1 ? std::log1p(-s) : 0.0; }

/// 2 asin^2(sqrt(s/2)): half of the square of the angle whose 1 - cos is s; s in [0, 1].
inline double half_square_of_angle(double s) {
  const double half_angle = std::asin(std::sqrt(std::min(s, 1.0) / 2));
  return 2 * half_angle * half_angle;
}

/// 1 - q s. In a narrow type q keeps all of its digits, so that those of a small difference are right.
inline double one_minus_product(double q, double s) { return 1 - q * s; }

/// The type of number in a Real: its own, or that of a register's lanes.
template <class Real>
struct ScalarOf {
  using Type = typename Real::Scalar;
};
template <>
struct ScalarOf<double> {
  using Type = double;
};

/// Smallest u whose power `k` is a normal number of that type.
template <class Scalar>
inline double smallest_base(int k) {
  return std::exp2(double(std::numeric_limits<Scalar>::min_exponent - 1) / k);
}

}  // namespace lobelia
