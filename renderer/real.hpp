// The functions that lobes and models use, for double. renderer/kernels/lanes-inl.hpp has them for a SIMD register,
// so that each formula is written once.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pictures/half.hpp"

namespace lobelia {

/// `value` where a < b, else 0, even where `value` is NaN.
inline double where_less(double a, double b, double value) { return a < b ? value : 0.0; }

/// e^x for x <= 0; 0 instead of subnormal numbers, which can take a hundred times as long.
inline double exp_or_zero(double x) {
  return x >= std::log(std::numeric_limits<double>::min()) ? std::exp(x) : 0.0;
}

/// ln(1 - s) for s in [0, 1), anything finite for other s. Computed without 1 - s, which would lose the digits of a
/// small s: a large n multiplies the error (at n = 1e6 no digit would be left in float32).
inline double log_one_minus(double s) { return s < 1 ? std::log1p(-s) : 0.0; }

/// 2 asin^2(sqrt(s/2)): half of the squared angle with 1 - cos = s; s in [0, 1].
inline double half_square_of_angle(double s) {
  const double half_angle = std::asin(std::sqrt(std::min(s, 1.0) / 2));
  return 2 * half_angle * half_angle;
}

/// 1 - q s. q keeps all its digits in a narrow type too, so that a small difference is exact.
inline double one_minus_product(double q, double s) { return 1 - q * s; }

/// a b + c, rounded once where the processor can.
inline double multiply_add(double a, double b, double c) { return a * b + c; }

/// The number type of a Real: its own, or that of a register's lanes.
template <class Real>
struct ScalarOf {
  using Type = typename Real::Scalar;
};
template <>
struct ScalarOf<double> {
  using Type = double;
};

// For half floats. Functions that no processor has are rounded once, as exp and log are.

template <Subnormals kKind>
HalfOf<kKind> where_less(HalfOf<kKind> a, HalfOf<kKind> b, HalfOf<kKind> value) {
  return a < b ? value : HalfOf<kKind>(0);
}
/// Not 0 for subnormal numbers, which are part of what is emulated.
template <Subnormals kKind>
HalfOf<kKind> exp_or_zero(HalfOf<kKind> x) {
  return exp(x);
}
template <Subnormals kKind>
HalfOf<kKind> log_one_minus(HalfOf<kKind> s) {
  return log_one_minus(double(s));
}
template <Subnormals kKind>
HalfOf<kKind> half_square_of_angle(HalfOf<kKind> s) {
  return half_square_of_angle(double(s));
}
/// With two roundings: `a * b + c` in a shader may be either.
template <Subnormals kKind>
HalfOf<kKind> multiply_add(HalfOf<kKind> a, HalfOf<kKind> b, HalfOf<kKind> c) {
  return a * b + c;
}
/// q is a half float too: a product with more digits would be one of another precision.
template <Subnormals kKind>
HalfOf<kKind> one_minus_product(double q, HalfOf<kKind> s) {
  return 1 - q * s;
}

/// The smallest u with a normal number u^k of that type.
template <class Scalar>
inline double smallest_base(int k) {
  return std::exp2(double(std::numeric_limits<Scalar>::min_exponent - 1) / k);
}

}  // namespace lobelia
