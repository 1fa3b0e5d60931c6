// The few functions that lobes and models are written in, for double. renderer/kernels/lanes-inl.hpp
// has the same for a SIMD register, so that each formula stands once and serves both.
#pragma once

#include <algorithm>
#include <cmath>

namespace lobelia {

/// max(x, 0)
inline double positive_part(double x) { return std::max(x, 0.0); }

/// 1 where x > 0, else 0.
inline double step_positive(double x) { return x > 0 ? 1.0 : 0.0; }

/// (1 - s)^n for s in [0, 2], n > 0; 0 where s >= 1. Through log1p: 1 - s would lose the digits of
/// a small s, which a large n multiplies (at n = 1e6 none would be left in float32).
inline double power_of_one_minus(double s, double n) {
  return s < 1 ? std::exp(n * std::log1p(-s)) : 0.0;
}

/// The integral of u^p (1 - u)^j over u from u0 to 1, for p > -1, 0 <= u0 <= 1, j = 0..3.
/// Its terms of order j > 0 cancel to 1/p of their size, which is harmless where it is added to the
/// term of order 0, p times larger than the rest (see EnergyIntegral).
inline double power_moment(double p, double u0, int j) {
  constexpr double kBinomial[4][4] = {{1}, {1, -1}, {1, -2, 1}, {1, -3, 3, -1}};
  double sum = 0;
  for (int i = 0; i <= j; ++i) {
    const double q = p + i + 1;  // (1 - u0^q) / q
    const double tail = u0 > 0 ? -std::expm1(q * std::log(u0)) : 1.0;
    sum += kBinomial[j][i] * tail / q;
  }
  return sum;
}

}  // namespace lobelia
