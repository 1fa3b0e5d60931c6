// Extremes: a dense scan, then Brent's method between the neighbours of the best point, because a scan
// alone would say of a maximum between two points that it is at one of them.
#pragma once

#include <boost/math/tools/minima.hpp>

#include "reference_scenes/engines/analytic/formulas/printed.hpp"

namespace lobelia::paper {

struct Extreme {
  Real value = 0;
  Real at = 0;
};

/// The largest f(x), x in [from, to]; ends included. f must have one maximum between any three points
/// of the scan.
template <class F>
Extreme largest(F f, Real from, Real to, int steps) {
  const auto point = [&](int i) { return from + (to - from) * Real(i) / Real(steps); };
  int best = 0;
  Real best_value = f(from);
  for (int i = 1; i <= steps; ++i)
    if (const Real here = f(point(i)); here > best_value) best = i, best_value = here;
  const Real low = point(std::max(0, best - 1)), high = point(std::min(steps, best + 1));
  constexpr int kBits = 30;  // of the place; the value is then exact to all its digits
  const auto [x, negated] =
      boost::math::tools::brent_find_minima([&](Real at) { return -f(at); }, low, high, kBits);
  if (-negated > best_value) return {-negated, x};
  return {best_value, point(best)};
}

/// The same over the exponent n, a real number: the scan visits every integer of the paper's range.
template <class F>
Extreme largest_over_n(F f) {
  return largest(f, kFirstExponent, kLastExponent, kLastExponent - kFirstExponent);
}

}  // namespace lobelia::paper
