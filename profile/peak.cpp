#include "profile/peak.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/words/constants.hpp"
#include "profile/least_squares.hpp"

namespace lobelia {
namespace {

constexpr std::size_t kMostTerms = 15;  // of degree 4
using Terms = std::array<double, kMostTerms>;

constexpr double kCap = 0.8;
// A smaller cap of a broad highlight has enough pixels, and a quarter of the terms beyond degree 4.
constexpr double kBroadSemiAxis = 10, kBroadCap = 0.9;
// Across fewer pixels a polynomial of degree 4 may oscillate between them.
constexpr double kSmallestSemiAxis = 3;
// More equal values than the top of a peak of floats or half floats has. A peak clipped by 2 % or more has a tenth of
// its cap equal.
constexpr std::size_t kFewestOfAPlateau = 5;
constexpr double kPlateauOfCap = 0.1;

/// A polynomial of two variables, in the terms x^a y^b with a + b <= degree, about `origin` in units of `unit`.
struct Polynomial {
  int degree;
  FilmPoint origin;
  double unit;
  Terms coefficients;

  static std::size_t terms(int degree) { return std::size_t((degree + 1) * (degree + 2) / 2); }

  struct Value {
    double f = 0, fx = 0, fy = 0, fxx = 0, fxy = 0, fyy = 0;
  };
  Value value(double x, double y) const {
    Value v;
    std::size_t k = 0;
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b) {
        const double c = coefficients[k++];
        const auto x_to = [&](int less) { return a < less ? 0.0 : std::pow(x, a - less); };
        const auto y_to = [&](int less) { return b < less ? 0.0 : std::pow(y, b - less); };
        v.f += c * x_to(0) * y_to(0);
        v.fx += c * a * x_to(1) * y_to(0);
        v.fy += c * b * x_to(0) * y_to(1);
        v.fxx += c * a * (a - 1) * x_to(2) * y_to(0);
        v.fxy += c * a * b * x_to(1) * y_to(1);
        v.fyy += c * b * (b - 1) * x_to(0) * y_to(2);
      }
    return v;
  }
};

/// Fits the logarithm of value / largest; nothing if a value has no logarithm.
std::optional<Polynomial> fit(const Field& field, const std::vector<std::size_t>& pixels,
                              int degree, FilmPoint origin, double unit, double largest) {
  NormalEquations<kMostTerms> normal(Polynomial::terms(degree));
  Terms row{};
  for (const std::size_t pixel : pixels) {
    const double share = field.values[pixel] / largest;
    if (!(share > 0)) return std::nullopt;
    const FilmPoint place = pixel_centre(field, pixel);
    const double x = (place.x - origin.x) / unit, y = (place.y - origin.y) / unit;
    std::size_t k = 0;
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b) row[k++] = std::pow(x, a) * std::pow(y, b);
    normal.add(row, share * share, std::log(share));
  }
  if (!normal.factorise()) return std::nullopt;
  return Polynomial{degree, origin, unit, normal.solution()};
}

/// Newton's iteration from `start`; nothing unless it ends on a maximum at most `reach` pixels away.
std::optional<Peak> maximum(const Polynomial& polynomial, FilmPoint start, double reach) {
  double x = (start.x - polynomial.origin.x) / polynomial.unit;
  double y = (start.y - polynomial.origin.y) / polynomial.unit;
  const double from_x = x, from_y = y;
  for (int step = 0; step < 30; ++step) {
    const Polynomial::Value v = polynomial.value(x, y);
    const double determinant = v.fxx * v.fyy - v.fxy * v.fxy;
    if (!(v.fxx < 0 && determinant > 0)) return std::nullopt;
    const double dx = (v.fyy * v.fx - v.fxy * v.fy) / determinant;
    const double dy = (v.fxx * v.fy - v.fxy * v.fx) / determinant;
    x -= dx;
    y -= dy;
    if (!(std::hypot(x - from_x, y - from_y) * polynomial.unit <= reach)) return std::nullopt;
    if (std::hypot(dx, dy) < 1e-12) break;
  }
  return Peak{
      {polynomial.origin.x + x * polynomial.unit, polynomial.origin.y + y * polynomial.unit},
      std::exp(polynomial.value(x, y).f),
      PeakFound::kFitted};
}

std::optional<Peak> fitted(const Field& field, std::vector<std::size_t> cap,
                           std::size_t brightest) {
  const double largest = field.values[brightest];
  const FilmPoint start = pixel_centre(field, brightest);
  Axes axes = principal_axes(field, cap, 0);
  if (2 * axes.minor_sigma >= kBroadSemiAxis) {
    cap = region_above(field, brightest, kBroadCap * largest);
    axes = principal_axes(field, cap, 0);
  }
  // An evenly filled ellipse has semi-axes of twice the standard deviation.
  const double semi_major = 2 * axes.major_sigma;
  std::optional<Polynomial> polynomial;
  double reach = std::sqrt(2);
  if (2 * axes.minor_sigma >= kSmallestSemiAxis) {
    polynomial = fit(field, cap, 4, axes.centre, semi_major, largest);
    reach = semi_major;
  } else {
    std::vector<std::size_t> square;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) square.push_back(brightest + std::size_t(j * field.width + i));
    polynomial = fit(field, square, 2, start, 1, largest);
  }
  auto peak = polynomial ? maximum(*polynomial, start, reach) : std::nullopt;
  if (peak) peak->value *= largest;
  return peak;
}

}  // namespace

Peak locate_peak(const Field& field) {
  const std::size_t none = field.values.size();
  std::size_t brightest = none;
  for (std::size_t i = 0; i < none; ++i)
    if (std::isfinite(field.values[i]) && field.values[i] > 0 &&
        (brightest == none || field.values[i] > field.values[brightest]))
      brightest = i;
  if (brightest == none) return {{kNaN, kNaN}, kNaN, PeakFound::kNone, 0};
  return locate_peak(field, brightest);
}

Peak locate_peak(const Field& field, std::size_t brightest) {
  const double largest = field.values[brightest];
  Peak peak{pixel_centre(field, brightest), largest, PeakFound::kPixel, brightest};
  const std::vector<std::size_t> cap = region_above(field, brightest, kCap * largest);
  std::vector<std::size_t> equal;
  std::ranges::copy_if(cap, std::back_inserter(equal),
                       [&](std::size_t i) { return field.values[i] == largest; });
  if (equal.size() >= kFewestOfAPlateau &&
      double(equal.size()) >= kPlateauOfCap * double(cap.size())) {
    peak.place = principal_axes(field, equal, 0).centre;
    peak.found = PeakFound::kPlateau;
    return peak;
  }
  const int x = int(brightest % field.width), y = int(brightest / field.width);
  for (int j = y - 1; j <= y + 1; ++j)
    for (int i = x - 1; i <= x + 1; ++i)
      if (!std::isfinite(field.at(i, j))) {
        peak.found = PeakFound::kEdge;
        return peak;
      }
  if (auto better = fitted(field, cap, brightest)) {
    better->pixel = brightest;
    return *better;
  }
  return peak;
}

}  // namespace lobelia
