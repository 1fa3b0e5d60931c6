// Directions for exported functions.
#pragma once

#include <cmath>
#include <random>

#include "base/words/vec.hpp"

namespace lobelia {

struct Directions {
  Vec3 normal, to_eye, to_light;
};

/// Eye and light above the horizon; half of them where the highlight is, some grazing.
class RandomDirections {
 public:
  explicit RandomDirections(double exponent) : exponent_(exponent) {}
  Directions operator()() {
    Directions d{direction(), {}, {}};
    const double grazing = uniform_(random_) < 0.2 ? 1e-3 : 1;
    d.to_eye = above(d.normal, grazing);
    d.to_light = above(d.normal, grazing);
    if (uniform_(random_) < 0.5) {
      const double width = 2 / std::sqrt(exponent_);
      const Vec3 mirrored = 2 * dot(d.normal, d.to_eye) * d.normal - d.to_eye;
      const Vec3 nearby = normalize(mirrored + width * uniform_(random_) * direction());
      if (dot(nearby, d.normal) > 0) d.to_light = nearby;
    }
    return d;
  }

 private:
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return normalize({normal(random_), normal(random_), normal(random_)});
  }
  Vec3 above(Vec3 normal, double most) {
    const double height = most * (1e-6 + (1 - 1e-6) * uniform_(random_));
    const Vec3 any = direction(), across = normalize(any - dot(any, normal) * normal);
    return height * normal + std::sqrt(1 - height * height) * across;
  }
  double exponent_;
  std::mt19937_64 random_{1};
  std::uniform_real_distribution<double> uniform_;
};

}  // namespace lobelia
