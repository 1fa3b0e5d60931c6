// Directions for the laws: chosen at random once and for all, and as grazing as they come.
#pragma once

#include "base/words/vec.hpp"
#include "tests/renderer/laws/cases.hpp"

namespace lobelia {

/// A right-handed frame that is no frame of the axes.
struct Frame {
  Vec3 normal = normalize({0.3, -0.5, -0.8});
  Vec3 x = normalize(cross(normal, {0, 1, 0}));
  Vec3 y = cross(normal, x);
  Vec3 operator()(double polar, double azimuth) const {
    const double sine = std::sin(polar);
    return sine * std::cos(azimuth) * x + sine * std::sin(azimuth) * y + std::cos(polar) * normal;
  }
};

struct Pair {
  Vec3 to_eye, to_light;
};

/// Pairs above the horizon: anywhere, both grazing, and lights within a lobe of exponent `n` about the
/// mirror direction of the eye, where the highlight is.
inline std::vector<Pair> direction_pairs(const Frame& frame, double n) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto any_azimuth = [&] { return 2 * kPi * uniform(random); };
  std::vector<Pair> pairs;
  for (int i = 0; i < 100; ++i) {
    const double azimuth = any_azimuth(), polar = kPi / 2 * uniform(random);
    pairs.push_back({frame(polar, azimuth), frame(std::acos(1 - uniform(random)), any_azimuth())});
    const double grazing = kPi / 2 * (1 - std::pow(10, -5 * uniform(random)));
    pairs.push_back({frame(grazing, azimuth),
                     frame(kPi / 2 * (1 - std::pow(10, -5 * uniform(random))), any_azimuth())});
    const double spread = std::min(1.0, 3 / std::sqrt(n));
    const double mirrored = polar + spread * (uniform(random) - 0.5);
    pairs.push_back({frame(polar, azimuth),
                     frame(std::abs(mirrored), azimuth + kPi + spread * (uniform(random) - 0.5))});
  }
  std::erase_if(pairs, [&](const Pair& p) {
    return dot(frame.normal, p.to_eye) <= 0 || dot(frame.normal, p.to_light) <= 0;
  });
  return not_empty(pairs);
}

}  // namespace lobelia
