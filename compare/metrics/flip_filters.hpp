// The filters of LDR-FLIP: what the eye still resolves, and what it notices as edges and points.
#pragma once

#include <vector>

namespace lobelia {

/// Separable filters for one viewing distance; each has 2 * radius + 1 taps, the middle one
/// centred.
struct FlipFilters {
  explicit FlipFilters(float pixels_per_degree);

  int contrast_radius, feature_radius;
  /// Contrast sensitivity: achromatic, red-green, and blue-yellow as a sum of two Gaussians, each
  /// applied in both directions.
  std::vector<float> luminance, red_green, blue_yellow_1, blue_yellow_2;
  /// Feature detection: a Gaussian across and its first (edge) or second (point) derivative along.
  std::vector<float> gaussian, edge, point;
};

}  // namespace lobelia
