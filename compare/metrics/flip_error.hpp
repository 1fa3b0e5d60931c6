// The error map of FLIP, which LDR-FLIP and HDR-FLIP are made of. Source, agreement and why float: see
// flip_ldr.cpp.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "compare/display_light.hpp"
#include "compare/metrics/flip_filters.hpp"

namespace lobelia {

/// Columns [left, left + width), rows [top, top + height).
struct FlipTile {
  int left, top, width, height;
};

/// FLIP's error of each pixel of the tile, in [0, 1], its rows flip_padded(tile.width) apart.
void flip_tile_errors(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                      const FlipTile& tile, std::span<float> errors);

/// That of each pixel of the picture, in reading order.
std::vector<float> flip_error_map(const DisplayLight& a, const DisplayLight& b,
                                  const FlipFilters& filters);

struct FlipPooled {
  double mean, max;
};

/// Mean and maximum over a picture. errors_of(tile, errors) fills in the errors of a tile; many threads call it.
FlipPooled flip_pooled(int width, int height,
                       const std::function<void(const FlipTile&, std::span<float>)>& errors_of);

}  // namespace lobelia
