#include "renderer/albedo.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <vector>

#include "base/words/constants.hpp"
#include "renderer/lobe_properties.hpp"
#include "renderer/reflector.hpp"

namespace lobelia {
namespace {

constexpr double kNarrowestPiece = 1e-12;  ///< radians
constexpr double kSame = 1e-9;             ///< smaller differences are rounding

/// The integral of coefficient * lobe * (a factor of the moving cosine) over all directions of one vector while the other
/// stays. Lobes treat light and eye alike, so either may move.
///
/// The integral runs over the lobe's angle t and its azimuth p. With c and e the cosine and the sine of the
/// incidence, the Phong models turn the moving vector by x = t out of the mirror direction, and the Blinn models by
/// x = 2 t, because they turn H by t. Then
///   N.L = c cos x + e sin x cos p,
/// with the azimuths of the horizon where it is 0, and
///   dL = sin t dt dp,   for a half vector times 4 (V.H) = 4 (c cos t + e sin t cos p).
class HemisphereIntegral {
 public:
  explicit HemisphereIntegral(const Highlight& h)
      : coefficient_(radiance_coefficient(h)),
        lobe_(prepare(h.lobe, h.exponent)),
        half_vector_(info(h.model).angle == LobeAngle::kHalfVector),
        has_shadowing_(info(h.model).has_shadowing),
        width_(lobe_angle_at(lobe_, 0.5)),
        end_(lobe_angle_at(lobe_, 1e-20)) {}

  double operator()(double incidence, auto&& factor) const {
    const double c = std::cos(incidence), e = std::sin(incidence);
    const auto integrand = [&](double t) {
      return lobe_.value(versine(t)) * std::sin(t) * over_azimuth(c, e, t, factor);
    };
    const std::vector<double> pieces = pieces_of(incidence);
    double sum = 0;
    for (std::size_t i = 1; i < pieces.size(); ++i)
      sum += over_piece(integrand, pieces[i - 1], pieces[i]);
    return coefficient_ * sum;
  }

 private:
  double over_azimuth(double c, double e, double t, auto&& factor) const {
    const double x = half_vector_ ? 2 * t : t;
    const double up = c * std::cos(x), across = e * std::sin(x);
    if (up <= -across) return 0;  // all of it is below the horizon
    const double end = up >= across ? kPi : std::acos(-up / across);
    const double up_half = c * std::cos(t), across_half = e * std::sin(t);
    const auto integrand = [&](double azimuth) {
      const double cosine = std::cos(azimuth);
      const double spread = half_vector_ ? 4 * (up_half + across_half * cosine) : 1;
      return spread * factor(up + across * cosine);
    };
    // Shadowing changes within a cosine of alpha.
    if (has_shadowing_)
      return 2 * boost::math::quadrature::gauss_kronrod<double, 15>::integrate(integrand, 0.0, end,
                                                                               8, 1e-11);
    // Smooth where it is not cut off: 15 points leave 1e-15 of a polynomial in the cosine.
    return 2 * boost::math::quadrature::gauss<double, 15>::integrate(integrand, 0.0, end);
  }

  /// The places where the lobe or the horizon bends, with steps by a factor of four in between.
  std::vector<double> pieces_of(double incidence) const {
    const double scale = half_vector_ ? 0.5 : 1, cut_begins = scale * (kPi / 2 - incidence);
    std::array<double, 3> bends{cut_begins, scale * (kPi / 2 + incidence), end_};
    std::ranges::sort(bends);
    std::vector<double> pieces{0};
    for (const double bend : bends) {
      const double end = std::min(bend, end_);
      for (double next = std::max(kNarrowestPiece, std::min(width_, cut_begins)); next < end / 2;
           next = 4 * std::max(next, pieces.back()))
        if (next > pieces.back()) pieces.push_back(next);
      if (end > pieces.back()) pieces.push_back(end);
    }
    return pieces;
  }

  /// The cut-off azimuths begin like the root of the distance from a bend; u^2 (3 - 2 u) makes that smooth.
  static double over_piece(auto&& integrand, double begin, double end) {
    const auto smooth = [&](double u) {
      return integrand(begin + (end - begin) * u * u * (3 - 2 * u)) * 6 * u * (1 - u);
    };
    return (end - begin) * boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
                               smooth, 0.0, 1.0, 10, 1e-11);
  }

  double coefficient_;
  PreparedLobe lobe_;
  bool half_vector_, has_shadowing_;
  double width_, end_;
};

/// The incidences to measure at, in radians.
std::vector<double> incidences() {
  std::vector<double> result;
  for (int degree = 0; degree < 90; ++degree) result.push_back(degree * kPi / 180);
  for (const double left : {0.5, 0.2, 0.1, 0.05, 0.02}) result.push_back((90 - left) * kPi / 180);
  result.push_back(kMostGrazing);
  return result;
}

/// The largest value of a function of the incidence. 20 bits of the incidence are enough, because a maximum is flat.
AlbedoPeak peak(auto&& albedo) {
  const std::vector<double> at = incidences();
  AlbedoPeak largest{albedo(0.0), 0, std::nullopt};
  if (largest.albedo > 1 + kSame) largest.above_one_from = 0;
  std::size_t best = 0;
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double value = albedo(at[i]);
    if (value > 1 + kSame && !largest.above_one_from) {
      double below = at[i - 1], above = at[i];
      for (int step = 0; step < 30; ++step) {
        const double middle = (below + above) / 2;
        (albedo(middle) > 1 + kSame ? above : below) = middle;
      }
      largest.above_one_from = above;
    }
    if (value > largest.albedo + kSame) {
      largest.albedo = value, largest.incidence = at[i];
      best = i;
    }
  }
  if (best == 0) return largest;
  const auto [incidence, negative] = boost::math::tools::brent_find_minima(
      [&](double here) { return -albedo(here); }, at[best - 1],
      at[std::min(best + 1, at.size() - 1)], 20);
  if (-negative > largest.albedo + kSame) largest.albedo = -negative, largest.incidence = incidence;
  return largest;
}

double seen(const HemisphereIntegral& integral, const Highlight& h, double incidence) {
  const double n_dot_v = std::cos(incidence);
  return integral(incidence, [&](double n_dot_l) {
    return geometry_factor(h.model, h.exponent, n_dot_l, n_dot_v);
  });
}

double of_light(const HemisphereIntegral& integral, const Highlight& h, double incidence) {
  const double n_dot_l = std::cos(incidence);
  return integral(incidence, [&](double n_dot_v) {
    return geometry_factor(h.model, h.exponent, n_dot_l, n_dot_v) / n_dot_l * n_dot_v;
  });
}

}  // namespace

double directional_albedo(const Highlight& h, double incidence) {
  return seen(HemisphereIntegral(h), h, incidence);
}

double directional_albedo_of_light(const Highlight& h, double incidence) {
  return of_light(HemisphereIntegral(h), h, incidence);
}

AlbedoPeak largest_albedo(const Highlight& h) {
  const HemisphereIntegral integral(h);
  return peak([&](double incidence) { return seen(integral, h, incidence); });
}

AlbedoPeak largest_albedo_of_light(const Highlight& h) {
  const HemisphereIntegral integral(h);
  return peak([&](double incidence) { return of_light(integral, h, incidence); });
}

double reciprocity_gap(const Highlight& highlight) {
  const Reflector reflector({"", highlight, {1, 1, 1}, {}});
  const Vec3 normal{0, 0, 1};
  const auto brdf = [&](Vec3 to_eye, Vec3 to_light) {
    return reflector.eval(normal, to_eye, to_light).r / to_light.z;
  };
  double largest = 0;
  for (const double degrees : {5, 25, 45, 65, 85}) {
    const Vec3 to_eye{std::sin(degrees * kPi / 180), 0, std::cos(degrees * kPi / 180)};
    for (const double u : {0.1, 0.3, 0.5, 0.7, 0.9})
      for (const double v : {0.0, 0.125, 0.25, 0.375, 0.5}) {
        const auto drawn = reflector.sample(normal, to_eye, 0, u, v);
        if (!drawn) continue;
        const double there = brdf(to_eye, drawn->to_light), back = brdf(drawn->to_light, to_eye);
        const double larger = std::max(there, back);
        if (larger > 0) largest = std::max(largest, std::abs(there - back) / larger);
      }
  }
  return largest;
}

}  // namespace lobelia
