#include "profile/falloff_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/words/constants.hpp"
#include "profile/least_squares.hpp"

namespace lobelia {
namespace {

// Height, place, the lower Cholesky factor of the inverse ellipse, and the level.
constexpr std::size_t kUnknowns = 7;
using Unknowns = std::array<double, kUnknowns>;
constexpr std::size_t kFewestOfACurve = 20, kMostOfACurve = 20000;

struct FittedPixel {
  FilmPoint place;
  double value, error;
  bool clipped;
};

/// The share of the peak, and its derivative by q.
std::pair<double, double> falloff(Falloff family, double q) {
  if (family == Falloff::kGaussian) {
    const double share = std::exp2(-q);
    return {share, -std::numbers::ln2 * share};
  }
  const double scale = std::numbers::sqrt2 - 1, share = 1 / (1 + scale * q);
  return {share * share, -2 * scale * share * share * share};
}

/// The value at a place; `by` becomes the derivatives.
double model(Falloff family, const Unknowns& p, FilmPoint place, Unknowns& by) {
  const double dx = place.x - p[1], dy = place.y - p[2];
  const double s = p[3] * dx + p[4] * dy, t = p[5] * dy;
  const auto [share, slope] = falloff(family, s * s + t * t);
  const double steep = 2 * p[0] * slope;
  by = {share,
        -steep * s * p[3],
        -steep * (s * p[4] + t * p[5]),
        steep * s * dx,
        steep * s * dy,
        steep * t * dy,
        1};
  return p[0] * share + p[6];
}

/// Observed less fitted; 0 for a clipped pixel that the fit exceeds.
double residual(const FittedPixel& pixel, double fitted) {
  const double apart = pixel.value - fitted;
  return pixel.clipped ? std::max(0.0, apart) : apart;
}

double sum_of_squares(Falloff family, const std::vector<FittedPixel>& pixels, const Unknowns& p) {
  double sum = 0;
  Unknowns unused;
  for (const FittedPixel& pixel : pixels) {
    const double r = residual(pixel, model(family, p, pixel.place, unused));
    sum += r * r;
  }
  return sum;
}

NormalEquations<kUnknowns> equations(Falloff family, const std::vector<FittedPixel>& pixels,
                                     const Unknowns& p) {
  NormalEquations<kUnknowns> normal(kUnknowns);
  Unknowns row;
  for (const FittedPixel& pixel : pixels) {
    const double fitted = model(family, p, pixel.place, row);
    if (pixel.clipped && fitted >= pixel.value) continue;
    normal.add(row, 1, pixel.value - fitted);
  }
  return normal;
}

/// False if no step makes the squares less from the very start.
bool minimise(Falloff family, const std::vector<FittedPixel>& pixels, Unknowns& p) {
  constexpr int kSteps = 100;
  constexpr double kSmallestGain = 1e-12, kStiffest = 1e12;
  double stiffness = 1e-3, squares = sum_of_squares(family, pixels, p);
  bool moved = false;
  for (int step = 0; step < kSteps && stiffness < kStiffest; ++step) {
    auto normal = equations(family, pixels, p);
    normal.stiffen(1 + stiffness);
    if (!normal.factorise()) return moved;
    const Unknowns change = normal.solution();
    Unknowns next = p;
    for (std::size_t k = 0; k < kUnknowns; ++k) next[k] += change[k];
    const double after = sum_of_squares(family, pixels, next);
    if (!(after <= squares)) {
      stiffness *= 8;
      continue;
    }
    const bool done = squares - after <= kSmallestGain * squares;
    p = next;
    squares = after;
    moved = true;
    stiffness /= 8;
    if (done) break;
  }
  return moved;
}

/// The half-widths along the long and the short axis, of the factor's three numbers.
std::array<double, 2> half_widths(const Unknowns& p) {
  const double a = p[3] * p[3], b = p[3] * p[4], c = p[4] * p[4] + p[5] * p[5];
  const double mean = (a + c) / 2, spread = std::hypot((a - c) / 2, b);
  // The product of both is the determinant: no digits are lost in their difference.
  const double large = mean + spread, small = p[3] * p[3] * p[5] * p[5] / large;
  return {1 / std::sqrt(small), 1 / std::sqrt(large)};
}

FalloffFit no_curve(Falloff family, std::size_t pixels, std::string why) {
  const Estimate none{kNaN, kNaN};
  return {family, none, none, none, {kNaN, kNaN}, {}, kNaN, pixels, std::move(why)};
}

FalloffFit fit_one(Falloff family, const std::vector<FittedPixel>& pixels, const Axes& rough,
                   double brightest) {
  if (pixels.size() < kFewestOfACurve)
    return no_curve(family, pixels.size(), "too few pixels for a curve");
  const auto clipped = std::size_t(std::ranges::count_if(pixels, &FittedPixel::clipped));
  if (pixels.size() - clipped < kFewestOfACurve)
    return no_curve(family, pixels.size(), "too few of its pixels are not clipped");
  const double major = 1 / (2 * rough.major_sigma), minor = 1 / (2 * rough.minor_sigma);
  const FilmPoint m = rough.major;
  const double a = m.x * m.x * major * major + m.y * m.y * minor * minor;
  const double b = m.x * m.y * (major * major - minor * minor);
  const double c = m.y * m.y * major * major + m.x * m.x * minor * minor;
  const double l = std::sqrt(a);
  Unknowns p{clipped > 0 ? 1.5 * brightest : brightest,
             rough.centre.x,
             rough.centre.y,
             l,
             b / l,
             std::sqrt(std::max(0.0, c - b * b / a)),
             0};
  if (!minimise(family, pixels, p) || !(p[0] > 0) ||
      !std::ranges::all_of(p, [](double x) { return std::isfinite(x); }))
    return no_curve(family, pixels.size(), "no curve fits it");
  const auto widths = half_widths(p);
  constexpr double kFarthest = 10;
  if (!(widths[0] < kFarthest * 2 * rough.major_sigma && widths[1] > 0) ||
      !(p[0] < 1e3 * brightest))
    return no_curve(family, pixels.size(), "its flank does not say how high it would be");

  // How a figure moves with the pixels, from its derivatives by the unknowns.
  auto normal = equations(family, pixels, p);
  if (!normal.factorise()) return no_curve(family, pixels.size(), "no curve fits it");
  const double squares = sum_of_squares(family, pixels, p);
  const double freedom = double(pixels.size() - clipped - kUnknowns);
  const double misfit = squares / std::max(1.0, freedom);
  const auto error_of = [&](const Unknowns& derivatives) {
    const Unknowns influence = normal.solve(derivatives);
    double variance = 0;
    Unknowns row;
    for (const FittedPixel& pixel : pixels) {
      const double fitted = model(family, p, pixel.place, row);
      if (pixel.clipped && fitted >= pixel.value) continue;
      double weight = 0;
      for (std::size_t k = 0; k < kUnknowns; ++k) weight += influence[k] * row[k];
      variance += weight * weight * std::max(pixel.error * pixel.error, misfit);
    }
    return std::sqrt(variance);
  };
  std::array<Unknowns, 2> by_widths{};
  for (std::size_t k = 3; k < 6; ++k) {
    Unknowns more = p, less = p;
    const double step = 1e-5 * std::max(p[3], std::abs(p[5]));
    more[k] += step;
    less[k] -= step;
    for (std::size_t axis = 0; axis < 2; ++axis)
      by_widths[axis][k] = (half_widths(more)[axis] - half_widths(less)[axis]) / (2 * step);
  }
  FalloffFit fit;
  fit.family = family;
  fit.peak = {p[0], error_of({1})};
  fit.major_half_width = {widths[0], error_of(by_widths[0])};
  fit.minor_half_width = {widths[1], error_of(by_widths[1])};
  fit.place = {p[1], p[2]};
  fit.shape = {p[3], p[4], p[5]};
  fit.residual = std::sqrt(squares / double(pixels.size())) / p[0];
  fit.pixels = pixels.size();
  return fit;
}

}  // namespace

double value_at(const FalloffFit& fit, FilmPoint place) {
  const double dx = place.x - fit.place.x, dy = place.y - fit.place.y;
  const double s = fit.shape[0] * dx + fit.shape[1] * dy, t = fit.shape[2] * dy;
  return fit.peak.value * falloff(fit.family, s * s + t * t).first;
}

std::vector<FalloffFit> fit_falloff(const Field& above, const Axes& rough, double reach,
                                    const std::vector<bool>& clipped,
                                    std::span<const double> error) {
  const double a = reach * 2 * rough.major_sigma, b = reach * 2 * rough.minor_sigma;
  const int step = std::max(1, int(std::sqrt(kPi * a * b / double(kMostOfACurve))));
  std::vector<FittedPixel> pixels;
  double brightest = 0;
  for (int y = 0; y < above.height; y += step)
    for (int x = 0; x < above.width; x += step) {
      const double dx = x + 0.5 - rough.centre.x, dy = y + 0.5 - rough.centre.y;
      const double u = (rough.major.x * dx + rough.major.y * dy) / a;
      const double v = (-rough.major.y * dx + rough.major.x * dy) / b;
      const double value = above.at(x, y);
      if (u * u + v * v > 1 || std::isnan(value)) continue;
      const std::size_t i = above.index(x, y);
      pixels.push_back({{x + 0.5, y + 0.5}, value, error[i], clipped[i]});
      brightest = std::max(brightest, value);
    }
  std::vector<FalloffFit> fits;
  for (const Falloff family : {Falloff::kGaussian, Falloff::kGgx})
    fits.push_back(fit_one(family, pixels, rough, brightest));
  std::ranges::stable_sort(fits, {}, [](const FalloffFit& fit) {
    return std::isnan(fit.residual) ? kInfinity : fit.residual * fit.peak.value;
  });
  return fits;
}

}  // namespace lobelia
