#include "studies/paper/energy.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>

namespace lobelia::paper {
namespace {

/// Over [0, end] in pieces about the lobe's width, so that no piece is mostly empty. The integrands are analytic on each
/// piece, as the interval ends where the lobe does.
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

/// The circle of directions at the angle `a` from the lobe's axis. With c = cos of the azimuth,
/// p + q c is the cosine between such a direction and the normal (Phong), or the held direction (Blinn).
struct Circle {
  double p, q;
  double reach;  ///< azimuth up to which the other direction is above the horizon

  /// The azimuth where p + q cos(azimuth) is `level`.
  static double azimuth(double p, double q, double level) {
    if (p - q >= level) return std::numbers::pi;
    if (p + q <= level) return 0;
    return std::acos(std::clamp((level - p) / q, -1.0, 1.0));
  }
  double integral() const { return 2 * (p * reach + q * std::sin(reach)); }
  double integral_of_square() const {
    return 2 * (p * p * reach + 2 * p * q * std::sin(reach) +
                q * q * (reach / 2 + std::sin(2 * reach) / 4));
  }
};

/// The integral over azimuth in closed form, of 1 or of the other direction's cosine, per solid angle.
double around(bool half_vector, double theta, double a, bool with_cosine) {
  const double held = std::cos(theta), up = std::cos(a);
  Circle circle{held * up, std::sin(theta) * std::sin(a), 0};
  if (!half_vector) {
    circle.reach = Circle::azimuth(circle.p, circle.q, 0);
    return with_cosine ? circle.integral() : 2 * circle.reach;
  }
  // other = 2 (held.H) H - held; its cosine is 2 (held.H) cos a - cos theta, its solid angle 4 (held.H).
  circle.reach = Circle::azimuth(circle.p, circle.q, held / (2 * up));
  if (!with_cosine) return 4 * circle.integral();
  return 4 * (2 * up * circle.integral_of_square() - held * circle.integral());
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

double albedo(const Row& row, Lobe lobe, Real n, Real coefficient, double theta, Held held) {
  const bool half_vector = row.half_angle || row.distribution;
  const bool with_cosine = !row.is_rdf() || held == Held::kBeam;
  const double end = double(lobe == Lobe::kCs16 ? cs16_support(n) : kRightAngle);
  // Intervals end where the horizon begins to cut a circle and where it has cut it off: the integrand is like a square
  // root there, which tanh-sinh needs at an end.
  const double right_angle = std::numbers::pi / 2, share = half_vector ? 2 : 1;
  std::vector<double> ends{(right_angle - theta) / share, (right_angle + theta) / share, end};
  for (const double width : {2.0, 4.0, 8.0}) ends.push_back(width / std::sqrt(double(n)));
  std::sort(ends.begin(), ends.end());

  static boost::math::quadrature::tanh_sinh<double> quadrature;
  constexpr double kTolerance = 1e-10;
  // Lobes fall from their axis: what follows is less than 25 times this, where a figure has four digits.
  constexpr Real kNothing = 1e-14L;
  const auto integrand = [&](double a) {
    return double(value(lobe, Real(a), n)) * std::sin(a) *
           around(half_vector, theta, a, with_cosine);
  };
  double sum = 0, from = 0;
  for (const double to : ends) {
    if (!(to - from > 1e-12) || to > end) continue;
    if (value(lobe, Real(from), n) < kNothing) break;
    // Over 0..1, so that a narrow interval far from 0 has room for the points that crowd at its ends.
    const double width = to - from;
    const auto share_of = [&](double u) { return integrand(from + width * u); };
    sum += width * quadrature.integrate(share_of, 0.0, 1.0, kTolerance);
    from = to;
  }
  if (row.distribution) sum /= 4;
  if (row.is_rdf() && held == Held::kBeam) sum /= std::cos(theta);
  return double(coefficient) * sum;
}

}  // namespace lobelia::paper
