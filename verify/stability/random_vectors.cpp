#include "verify/stability/random_vectors.hpp"

namespace lobelia::stability {

Vec3 RandomVectors::direction() {
  return normalize({normal_(random_), normal_(random_), normal_(random_)});
}

/// Half of them down to 1e-9, by decades.
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
    // By up to a thousandth of what the vectors are apart, and of the lobe's width.
    const double step = 1e-3 * width_ * std::pow(10, -6 * uniform());
    const auto moved = [&](Vec3 a) { return a + step * length(a) * direction(); };
    const Triple near{moved(there.normal), moved(there.to_eye), moved(there.to_light)};
    if (dot(near.normal, near.to_light) > 1e-9 && dot(near.normal, near.to_eye) > 0) return near;
  }
}

}  // namespace lobelia::stability
