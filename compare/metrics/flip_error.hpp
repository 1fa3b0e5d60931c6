// The filters and the error map of FLIP, shared by LDR-FLIP and HDR-FLIP. Source, agreement and the reason for float:
// see flip_ldr.cpp.
#pragma once

#include <functional>
#include <vector>

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// Separable filters for one viewing distance. Each has 2 * radius + 1 taps; the middle one is the pixel itself.
struct FlipFilters {
  explicit FlipFilters(float pixels_per_degree);

  int contrast_radius, feature_radius;
  /// Contrast sensitivity: achromatic, red-green, and blue-yellow as a sum of two Gaussians, each applied in both
  /// directions.
  std::vector<float> luminance, red_green, blue_yellow_1, blue_yellow_2;
  /// Feature detection: a Gaussian across and its first (edge) or second (point) derivative along.
  std::vector<float> gaussian, edge, point;
};

/// Columns [left, left + width), rows [top, top + height).
struct FlipTile {
  int left, top, width, height;
};

/// Writes FLIP's error of each pixel of the tile, in [0, 1]. Rows are flip_padded(tile.width) apart.
void flip_tile_errors(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                      const FlipTile& tile, std::span<float> errors);

/// Fills in the values of a tile, in rows that are flip_padded(tile.width) apart. Called on many threads.
using FlipTileValues = std::function<void(const FlipTile& tile, std::span<float> values)>;

/// The errors of all pixels. With `needed`, only those in the smallest rectangle around its non-zero pixels are computed; the
/// others are 0.
PixelValues flip_map(int width, int height, const FlipTileValues& values_of,
                     std::span<const std::uint8_t> needed = {});

/// FLIP's error of each pixel, as flip_map().
PixelValues flip_error_map(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                           std::span<const std::uint8_t> needed = {});

/// HDR-FLIP's error of each pixel of the picture, and the exposure in stops at which it is so large; the first exposure
/// where there is no error. The input has exposures.
PixelValues flip_hdr_error_map(const MetricInput& input);
PixelValues flip_hdr_exposure_map(const MetricInput& input);

/// The metric's footprint.
int flip_radius(const MetricInput& input);

}  // namespace lobelia
