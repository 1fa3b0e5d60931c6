// Pictures with noise of kinds that renderers make, around an expectation that is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "compare/uncertainty/error_bars.hpp"
#include "tests/compare/pictures.hpp"

namespace lobelia::fixtures {

/// Uniform numbers in (0, 1), one after the other.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : state_(mix(seed)) {}
  double operator()() { return (double(mix(++state_) >> 11) + 0.5) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

enum class NoiseKind {
  kEven,        ///< normal, as strong everywhere
  kHighlight,   ///< gamma, in proportion to a sharp highlight
  kEdge,        ///< normal, on one side of a slanted edge only
  kSilhouette,  ///< hits and misses of few rays, on a ring that is a pixel wide
  kFireflies,   ///< weak, and one pixel in five hundred gets a large value in one replicate
};
inline constexpr NoiseKind kNoiseKinds[] = {NoiseKind::kEven, NoiseKind::kHighlight,
                                            NoiseKind::kEdge, NoiseKind::kSilhouette,
                                            NoiseKind::kFireflies};
inline const char* name(NoiseKind kind) {
  constexpr const char* kNames[] = {"even", "highlight", "edge", "silhouette", "fireflies"};
  return kNames[int(kind)];
}

inline constexpr int kNoisySide = 48;

/// The share of a pixel that a disc covers, where it is neither all nor nothing.
inline double covered_by_disc(double u, double v) {
  return 0.5 + (0.7 - std::hypot(u, v)) * kNoisySide / 2;
}

/// The three channels err together, as under a white light.
inline Image noisy(NoiseKind kind, std::uint64_t seed, int samples) {
  Uniform uniform(seed);
  return reddish(kNoisySide, kNoisySide, [&](double u, double v) {
    double value = 0.5;
    const double normal =
        std::sqrt(-2 * std::log(uniform())) * std::cos(6.283185307179586 * uniform());
    switch (kind) {
      case NoiseKind::kEven:
        value += 0.3 * normal / std::sqrt(samples);
        break;
      case NoiseKind::kHighlight: {
        double product = 0;
        for (int k = 0; k < samples; ++k) product -= std::log(uniform());
        value = 3 * std::exp(-20 * (u * u + v * v)) * product / samples;
        break;
      }
      case NoiseKind::kEdge:
        if (u + 0.4 * v > 0.1) value += 0.3 * normal / std::sqrt(samples);
        break;
      case NoiseKind::kSilhouette: {
        int hits = 0;
        for (int k = 0; k < samples; ++k) hits += uniform() < covered_by_disc(u, v);
        value = double(hits) / samples;
        break;
      }
      case NoiseKind::kFireflies:
        value += 0.05 * normal / std::sqrt(samples);
        // A firefly's expectation is 0, so that a pixel without one is not too dark.
        if (uniform() < 0.002) value += 20 * (uniform() < 0.5 ? 1 : -1);
        break;
    }
    return value;
  });
}

inline Image expectation(NoiseKind kind) {
  return reddish(kNoisySide, kNoisySide, [kind](double u, double v) {
    if (kind == NoiseKind::kHighlight) return 3 * std::exp(-20 * (u * u + v * v));
    if (kind == NoiseKind::kSilhouette) return std::clamp(covered_by_disc(u, v), 0.0, 1.0);
    return 0.5;
  });
}

/// The mean of `count` replicates of `samples` samples each.
inline NoisyPicture noisy_mean(NoiseKind kind, std::uint64_t seed, int count, int samples) {
  std::vector<Image> replicates;
  for (int r = 0; r < count; ++r)
    replicates.push_back(noisy(kind, mix(seed) + std::uint64_t(r), samples));
  return mean_of_replicates(replicates, false);
}

}  // namespace lobelia::fixtures
