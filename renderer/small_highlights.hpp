// Highlights that are smaller than a pixel. One ray a pixel misses them or counts them too often, so the pixels around
// them are averaged: by quadrature over the pixel, without random numbers.
#pragma once

#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia {

struct Plan;
struct Work;

/// With a narrower highlight a sum over pixels' centres is off by more than 3e-5 of its energy: 2 exp(-2 pi^2 w^2).
inline constexpr double kLeastWidth = 0.75;  // pixels
/// The largest error of an average, as a share of the highlight's energy.
inline constexpr double kAverageError = 1e-3;
/// Scenes with more pairs of a surface and a light are not searched.
inline constexpr std::size_t kMostPairsSearched = 4096;

struct SmallHighlight {
  double x = 0, y = 0;  ///< its middle on the film, in pixels from the upper left corner
  /// The standard deviation of a Gaussian with its curvature, in pixels: where it is narrowest, and across that.
  double width = 1, length = 1;
};

/// The small highlights that lights without a size throw on surfaces towards the camera. None is looked for where something
/// is random: each sample would need averages of its own.
std::vector<SmallHighlight> find_small_highlights(const Scene& scene);

struct AveragedPixel {
  int x = 0, y = 0;
  Rgb radiance;
};

/// The means over the pixels that such highlights touch, within kAverageError of their energy, in reading order. Adds the
/// rays to `work`, as those of antialiasing. `plan` is the scene's.
std::vector<AveragedPixel> average_small_highlights(const Scene& scene, const Plan& plan,
                                                    Work& work);

}  // namespace lobelia
