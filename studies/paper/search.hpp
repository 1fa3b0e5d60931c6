// Extremes: a dense scan, then Brent's method between the neighbours of the best point, because a maximum may lie
// between two points of the scan. Roots.
#pragma once

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include "studies/paper/claim.hpp"

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

/// The largest f of |lobe - cos^n| at one exponent, over angles up to `end`.
template <class OtherLobe>
Extreme largest_difference(OtherLobe lobe, Real n, Real end, int steps = 100) {
  return largest([&](Real x) { return std::abs(lobe(x, n) - cosine_lobe(x, n)); }, 0, end, steps);
}

/// The root of f to so many bits; f must change its sign once from `low` to `high`.
template <class F, class Number>
Number root(F f, Number low, Number high, int bits) {
  std::uintmax_t iterations = 60;
  return boost::math::tools::toms748_solve(
             f, low, high, boost::math::tools::eps_tolerance<Number>(bits), iterations)
      .first;
}

/// The figure of an extreme over n, found at its exponent.
inline Figure figure(std::string what, const Extreme& over_n, int digits) {
  return figure(std::move(what), over_n.value, digits, at_exponent(over_n.at));
}

}  // namespace lobelia::paper
