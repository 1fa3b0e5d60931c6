#include "studies/stability/vectors.hpp"

#include "reference_scenes/engines/analytic/formulas/definition.hpp"
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
  return {rounded(n), rounded(v),
          rounded(l), dot(difference, difference) / 2,
          dot(n, l),  double(std::sqrt(dot(sum, sum)))};
}

long double screened_lobe(LobeId lobe, long double s, double exponent) {
  return s < 1 ? lobe_definition(lobe, 1 - s, exponent) : 0;
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
