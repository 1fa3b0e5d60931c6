#include "studies/stability/vectors.hpp"

#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "reference_scenes/engines/analytic/formulas/vector.hpp"

namespace lobelia::stability {
namespace {

using Long3 = truth::Vector<long double>;
Vec3 rounded(Long3 a) { return {double(a.x), double(a.y), double(a.z)}; }

}  // namespace

ScreenedVectors screen(LobeAngle angle, const Triple& directions) {
  const Long3 n = normalize(Long3(directions.normal)), v = normalize(Long3(directions.to_eye)),
              l = normalize(Long3(directions.to_light));
  const Long3 sum = l + v;
  const Long3 difference =
      angle == LobeAngle::kReflection ? 2 * dot(n, v) * n - v - l : n - normalize(sum);
  return {rounded(n),
          rounded(v),
          rounded(l),
          dot(difference, difference) / 2,
          dot(n, l),
          dot(n, v),
          double(std::sqrt(dot(sum, sum)))};
}

long double screened_lobe(LobeId lobe, long double s, double exponent) {
  return s < 1 ? lobe_definition(lobe, 1 - s, exponent) : 0;
}

Factor factor(const Highlight& h, long double n_dot_l, long double n_dot_v, double unit) {
  const truth::ModelRow& model = truth::model_row(h.model);
  if (!model.has_shadowing)
    return {n_dot_l > 0 ? truth::geometry(model, h.exponent, n_dot_l, n_dot_v) : 0, 0};
  // Grows with N.L and falls with N.V. As one quotient, because the printed form has none at 0.
  const auto at = [&](long double l, long double v) -> long double {
    if (l <= 0) return 0;
    const long double least = alpha_squared(h.exponent);
    const auto root = [&](long double c) { return std::sqrt(least + (1 - least) * c * c); };
    return 2 * l / (l * root(std::max(v, 0.0L)) + std::max(v, 0.0L) * root(l));
  };
  const long double roundings = 4 * unit;
  const long double value = at(n_dot_l, n_dot_v);
  const long double high = at(n_dot_l + roundings, n_dot_v - roundings),
                    low = at(n_dot_l - roundings, n_dot_v + roundings);
  // The quotient's own dozen roundings.
  return {value, double(std::max(high - value, value - low) + 3 * roundings * value)};
}

Vec3 RandomVectors::direction() {
  return normalize({normal_(random_), normal_(random_), normal_(random_)});
}

/// Half of them are spread by decades down to 1e-9.
double RandomVectors::grazing_cosine() {
  const double x = uniform();
  return uniform() < 0.5 ? 1 - x : std::pow(10, -9 * x);
}

Triple RandomVectors::next() {
  for (;;) {
    const Vec3 n = direction(), along = normalize(cross(n, direction()));
    const double cosine = grazing_cosine(), sine = std::sqrt(1 - cosine * cosine);
    const Vec3 v = cosine * n + sine * along;
    // From a thousandth of the lobe's width to eight widths, by decades.
    const double chord = std::min(1.5, 8 * std::pow(10, -4 * uniform()) * width_);
    Vec3 l;
    if (angle_ == LobeAngle::kReflection) {
      l = 2 * cosine * n - v + chord * direction();
    } else {
      const Vec3 h = normalize(n + chord * direction());
      l = 2 * dot(v, h) * h - v;
    }
    if (dot(n, l) > 1e-9) return {n, v, l};
  }
}

Triple RandomVectors::beside(const Triple& there) {
  for (;;) {
    // Up to a thousandth of the lobe's width.
    const double step = 1e-3 * width_ * std::pow(10, -6 * uniform());
    const auto moved = [&](Vec3 a) { return a + step * length(a) * direction(); };
    const Triple near{moved(there.normal), moved(there.to_eye), moved(there.to_light)};
    if (dot(near.normal, near.to_light) > 1e-9 && dot(near.normal, near.to_eye) > 0) return near;
  }
}

double by_kernel(const Highlight& h, const ScreenedVectors& v, double& bound) {
  const Precision precision = sufficient_precision(h, v.half_length);
  bound = shading_error_bound(precision, h, v.half_length);
  Vec3Chunk normal{}, to_eye{}, to_light{};
  put(normal, 0, v.normal), put(to_eye, 0, v.to_eye), put(to_light, 0, v.to_light);
  alignas(64) double value[16];
  kernels().shade(h, precision)(h, 1, normal, to_eye, to_light, value);
  return value[0];
}

}  // namespace lobelia::stability
