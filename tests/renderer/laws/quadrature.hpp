// Integrals for the laws, by adaptive quadrature that knows of a lobe only how wide it is.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <vector>

namespace lobelia {

/// Over [begin, end], halved until the error is below `allowed` or 1e-11 of the value, which is more
/// than the rounding of what is integrated: towards a corner as often as it takes.
inline double integrate_adaptively(auto&& f, double begin, double end, double allowed,
                                   int halvings = 50) {
  // Boost states the error of an interval as if it were 2 long: so over [-1, 1].
  const double half = (end - begin) / 2;
  double error = 0;
  const double value =
      half * boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                 [&](double x) { return f(begin + half * (1 + x)); }, -1.0, 1.0, 0, 0, &error);
  error *= half;
  const double middle = (begin + end) / 2;
  if (error <= std::max(allowed, 1e-11 * std::abs(value)) || halvings == 0 || middle <= begin ||
      middle >= end)
    return value;
  return integrate_adaptively(f, begin, middle, allowed / 2, halvings - 1) +
         integrate_adaptively(f, middle, end, allowed / 2, halvings - 1);
}

/// Over [0, end], of a function that is not negative, to 1e-11 of the result or better. In pieces that begin at
/// `width` and grow.
inline double integrate(auto&& f, double width, double end) {
  std::vector<double> pieces{0};
  for (double next = width; next < end / 2; next *= 2) pieces.push_back(next);
  pieces.push_back(end);
  double rough = 0, sum = 0;
  for (std::size_t i = 1; i < pieces.size(); ++i)
    rough += boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, pieces[i - 1],
                                                                           pieces[i], 0);
  for (std::size_t i = 1; i < pieces.size(); ++i)
    sum += integrate_adaptively(f, pieces[i - 1], pieces[i], 1e-13 * rough);
  return sum;
}

}  // namespace lobelia
