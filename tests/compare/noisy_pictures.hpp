// Pictures with noise of kinds that renderers make, around an expectation that is known.
#pragma once

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

/// The three channels err together, as under a white light. `strength` divides all noise.
inline Image noisy(NoiseKind kind, std::uint64_t seed, int samples) {
  Uniform uniform(seed);
  Image image(kNoisySide, kNoisySide);
  for (int y = 0; y < kNoisySide; ++y)
    for (int x = 0; x < kNoisySide; ++x) {
      const double u = (x + 0.5) / kNoisySide * 2 - 1, v = (y + 0.5) / kNoisySide * 2 - 1;
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
          const double covered = 0.5 + (0.7 - std::hypot(u, v)) * kNoisySide / 2;
          int hits = 0;
          for (int k = 0; k < samples; ++k) hits += uniform() < covered;
          value = double(hits) / samples;
          break;
        }
        case NoiseKind::kFireflies:
          value += 0.05 * normal / std::sqrt(samples);
          // Of expectation 0, so that a pixel without one is not too dark.
          if (uniform() < 0.002) value += 20 * (uniform() < 0.5 ? 1 : -1);
          break;
      }
      const auto pixel = image.pixel(x, y);
      pixel[0] = float(value), pixel[1] = float(0.8 * value), pixel[2] = float(0.6 * value);
    }
  return image;
}

inline Image expectation(NoiseKind kind) {
  Image image(kNoisySide, kNoisySide);
  for (int y = 0; y < kNoisySide; ++y)
    for (int x = 0; x < kNoisySide; ++x) {
      const double u = (x + 0.5) / kNoisySide * 2 - 1, v = (y + 0.5) / kNoisySide * 2 - 1;
      double value = 0.5;
      if (kind == NoiseKind::kHighlight) value = 3 * std::exp(-20 * (u * u + v * v));
      if (kind == NoiseKind::kSilhouette)
        value = std::clamp(0.5 + (0.7 - std::hypot(u, v)) * kNoisySide / 2, 0.0, 1.0);
      const auto pixel = image.pixel(x, y);
      pixel[0] = float(value), pixel[1] = float(0.8 * value), pixel[2] = float(0.6 * value);
    }
  return image;
}

/// The mean of `count` replicates of `samples` samples each.
inline NoisyPicture noisy_mean(NoiseKind kind, std::uint64_t seed, int count, int samples) {
  std::vector<Image> replicates;
  for (int r = 0; r < count; ++r)
    replicates.push_back(noisy(kind, mix(seed) + std::uint64_t(r), samples));
  return mean_of_replicates(replicates, false);
}

}  // namespace lobelia::fixtures
