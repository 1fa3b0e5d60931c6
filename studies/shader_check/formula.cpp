#include "studies/shader_check/formula.hpp"

#include <algorithm>
#include <cmath>

#include "base/pictures/half.hpp"
#include "renderer/models/smith.hpp"

namespace lobelia::shader_check {
namespace {

/// In place of what a float32 cannot hold, so that sums of squares stay finite.
constexpr double kInfinite = 1e38;

Point reversed(Point point, Reversed which) {
  if (which == Reversed::kLight) point.to_light = -point.to_light;
  if (which == Reversed::kNormal ||
      (which == Reversed::kToLight && dot(point.normal, point.to_light) < 0))
    point.normal = -point.normal;
  if (which == Reversed::kEye) point.to_eye = -point.to_eye;
  return point;
}

double s_of(const Formula& formula, const Geometry& g) {
  double s = formula.angle == LobeAngle::kReflection ? g.s_mirror : g.s_half;
  if (formula.lobe_cosine) s = 1 - formula.lobe_cosine(g);
  if (formula.mirrored) s = 1 - std::abs(1 - s);
  if (formula.least_cosine > 0) s = std::min(s, 1 - formula.least_cosine);
  if (formula.half == Formula::Half::kS) s = rounded_to_half(s);
  if (formula.half == Formula::Half::kCosine) s = 1 - rounded_to_half(1 - s);
  return s;
}

/// N.L, or what the formula has for it; 0 where it is black.
double light_of(const Formula& formula, const Geometry& g) {
  using enum Formula::Behind;
  switch (formula.behind) {
    case kBlack:
      return std::max(g.n_dot_l, 0.0);
    case kSigned:
      return g.n_dot_l;
    case kAbsolute:
      return std::abs(g.n_dot_l);
    case kLeast:
      return std::max(g.n_dot_l, formula.least_light);
    case kReversed:
      return std::min(g.n_dot_l, 0.0);
    case kReversedAbsolute:
      return std::max(-g.n_dot_l, 0.0);
  }
  return 0;
}

double factor_of(const Formula& formula, const Geometry& g) {
  const double light = light_of(formula, g);
  if (light == 0) return 0;
  double factor = formula.cosine ? formula.cosine(light, g) : 1;
  const double l = std::abs(light), v = std::abs(g.n_dot_v);
  if (formula.geometry_term) factor *= formula.geometry_term(l, v, g, formula.exponent);
  if (formula.least_product > 0 || formula.more_product > 0)
    factor *= 4 * l * v / (std::max(4 * l * v, formula.least_product) + formula.more_product);
  if (formula.f0 >= 0) factor *= formula.f0 + (1 - formula.f0) * formula.fresnel(g);
  return std::isfinite(factor) ? factor : 0;
}

}  // namespace

Seen::Seen(const Point& point)
    : geometry{Geometry(point), Geometry(reversed(point, Reversed::kLight)),
               Geometry(reversed(point, Reversed::kNormal)),
               Geometry(reversed(point, Reversed::kEye)),
               Geometry(reversed(point, Reversed::kToLight))} {}

double fresnel_power(const Geometry& geometry) {
  const double one_minus = 1 - std::max(geometry.v_dot_h, 0.0), square = one_minus * one_minus;
  return square * square * one_minus;
}

double smith_term(double n_dot_l, double n_dot_v, const Geometry&, double exponent) {
  return HWY_NAMESPACE::smith_factor(alpha_squared(exponent), n_dot_l, n_dot_v);
}

Formula own_formula(const Highlight& highlight, double exponent) {
  Formula formula{
      .angle = info(highlight.model).angle, .lobe = highlight.lobe, .exponent = exponent};
  if (info(highlight.model).applies_cosine)
    formula.cosine = [](double light, const Geometry&) { return light; };
  if (info(highlight.model).has_shadowing) formula.geometry_term = smith_term;
  return formula;
}

std::vector<double> lobe_values(const Formula& formula, std::span<const Seen> points) {
  std::vector<double> values;
  values.reserve(points.size());
  const PreparedLobe lobe = prepare(formula.lobe, formula.exponent);
  for (const Seen& seen : points) {
    const double s = s_of(formula, seen.as(formula.reversed));
    // A vector that is not normalised may have a cosine over 1.
    const double value = s < 0   ? std::min(std::pow(1 - s, formula.exponent), kInfinite)
                         : s < 1 ? lobe.value(s)
                                 : 0;
    values.push_back(std::isfinite(value) ? value : 0);
  }
  return values;
}

std::vector<double> factor_values(const Formula& formula, std::span<const Seen> points) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const Seen& seen : points) values.push_back(factor_of(formula, seen.as(formula.reversed)));
  return values;
}

std::vector<double> shape_values(const Formula& formula, std::span<const Seen> points) {
  std::vector<double> values = lobe_values(formula, points);
  const std::vector<double> factors = factor_values(formula, points);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= factors[i];
  return values;
}

}  // namespace lobelia::shader_check
