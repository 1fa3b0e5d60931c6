// Directions for exported functions, and how near to the truth they have to come.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/vec.hpp"
#include "renderer/precision.hpp"

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

/// The allowed error as a share of the peak: the bound of the renderer's own float32 (docs/numerics.md), which
/// depends on the length of L + V, plus the coefficient's error.
class Tolerance {
 public:
  explicit Tolerance(const Highlight& highlight) : highlight_(highlight) {}
  double at(const Directions& d) {
    const double half_length = length(d.to_eye + d.to_light);
    const int power = std::clamp(int(std::floor(std::log2(half_length))), -30, 1);
    const auto [entry, is_new] = of_power_.try_emplace(power, 0);
    if (is_new)
      entry->second = 3e-6 + shading_error_bound(Precision::kFloat32, highlight_, std::exp2(power));
    return entry->second;
  }

 private:
  Highlight highlight_;
  std::map<int, double> of_power_;
};

}  // namespace lobelia
