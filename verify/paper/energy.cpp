#include "verify/paper/energy.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace lobelia::paper {
namespace {

/// Over [0, end] in pieces about the lobe's width, so that no piece is mostly empty. The integrands are
/// analytic on each: where a lobe ends, so does the interval.
template <class F>
Real integrate(F f, Real end, Real width) {
  using Quadrature = boost::math::quadrature::gauss_kronrod<Real, 31>;
  constexpr unsigned kBisections = 6;
  constexpr Real kTolerance = 1e-16L;
  Real sum = 0, from = 0;
  for (Real to = width; from < end; to *= 2) {
    const Real last = std::min(to, end);
    sum += Quadrature::integrate(f, from, last, kBisections, kTolerance);
    from = last;
  }
  return sum;
}

}  // namespace

Real hemisphere_integral(const Row& row, Lobe lobe, Real n, Cut cut) {
  const Real angles = row.half_angle ? 2 : 1;
  Real end = kRightAngle;
  if (lobe == Lobe::kCs16) end = std::min(end, angles * cs16_support(n));
  if (cut == Cut::kPrinted) end = std::min(end, printed_theta_cr(n));
  const auto integrand = [&](Real x) {
    return value(lobe, x / angles, n) * (row.cosine ? std::cos(x) : 1) * std::sin(x);
  };
  return 2 * kPi * integrate(integrand, end, 2 * angles / std::sqrt(n));
}

Real schlick_integral(Real n) {
  return 2 * kPi *
         integrate([n](Real x) { return schlick_lobe(x, n) * std::sin(x); }, kRightAngle,
                   2 / std::sqrt(n));
}

}  // namespace lobelia::paper
