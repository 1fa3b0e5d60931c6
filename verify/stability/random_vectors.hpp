// Random vectors about a highlight: its middle, its flank and its foot, oblique and grazing.
#pragma once

#include <random>

#include "core/vec.hpp"
#include "renderer/highlight.hpp"

namespace lobelia::stability {

/// Directions, not of unit length: what they point to exactly is the truth.
struct Triple {
  Vec3 normal, to_eye, to_light;
};

class RandomVectors {
 public:
  RandomVectors(LobeAngle angle, double exponent, std::uint64_t seed)
      : angle_(angle), width_(1 / std::sqrt(exponent)), random_(seed) {}

  Triple next();
  /// A little beside `there`: the same place of the lobe, other roundings.
  Triple beside(const Triple& there);

 private:
  double uniform() { return uniform_(random_); }
  Vec3 direction();
  double grazing_cosine();

  LobeAngle angle_;
  double width_;  ///< of the lobe, radians
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0, 1};
  std::normal_distribution<double> normal_;
};

}  // namespace lobelia::stability
