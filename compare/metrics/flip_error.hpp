// The error map of FLIP, shared by LDR-FLIP and HDR-FLIP. Source, agreement and the reason for float:
// see flip_ldr.cpp.
#pragma once

#include <functional>

#include "compare/metrics/flip_filters.hpp"
#include "compare/metrics/metric.hpp"

namespace lobelia {

/// Columns [left, left + width), rows [top, top + height).
struct FlipTile {
  int left, top, width, height;
};

/// The part of the tile that has a pixel, within `radius`, where the pictures differ. Beyond it there is no error.
FlipTile differing_part(const Image& a, const Image& b, const FlipTile& tile, int radius);

/// Writes the logarithm to base 2 of FLIP's error of each pixel of `part`, which is in `tile`; minus infinity for no error.
/// Rows of the tile are flip_padded(tile.width) apart. Pixels beyond the part are not touched.
void flip_tile_logs(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                    const FlipTile& tile, const FlipTile& part, std::span<float> logs);

/// FLIP's error of each pixel of the tile, in [0, 1], in the same rows.
void flip_tile_errors(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                      const FlipTile& tile, std::span<float> errors);

/// Fills in the values of a tile, in rows that are flip_padded(tile.width) apart. Called on many threads.
using FlipTileValues = std::function<void(const FlipTile& tile, std::span<float> values)>;

/// The errors of all pixels. With `needed`, only those in the smallest rectangle around its non-zero pixels are computed;
/// the others are 0.
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
