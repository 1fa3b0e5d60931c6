// Part of a picture as FLIP's filters leave it.
#pragma once

#include <hwy/aligned_allocator.h>

#include <vector>

#include "compare/display_light.hpp"
#include "compare/metrics/flip_filters.hpp"
#include "compare/metrics/flip_kernels.hpp"

namespace lobelia {

/// Columns [left, left + width), rows [top, top + height).
struct FlipTile {
  int left, top, width, height;
};

/// A tile of a picture after the filters, row by row from the top; beyond the picture's border the border's
/// pixels repeat. Holds no more rows than the filters are high, so that they stay in the cache.
class FlipTileRows {
 public:
  /// The filters and what DisplayLight shows must outlive it.
  FlipTileRows(const DisplayLight& shown, const FlipFilters& filters, const FlipTile& tile);

  /// The next row: flip_padded(tile.width) pixels, valid until the next call.
  const FlipFiltered& next();

 private:
  /// What has been filtered along the rows, and is then filtered down the columns.
  enum Plane { kY, kCx, kCz1, kCz2, kSmooth, kEdge, kPoint, kPlanes };

  float* row(Plane plane, int y);
  void filter_along(int y);

  DisplayLight shown_;
  const FlipFilters& filters_;
  FlipTile tile_;
  int radius_;    ///< of the largest filter
  int filtered_;  ///< rows above this one have been filtered along
  int next_;      ///< row that next() is to return
  std::size_t padded_, extended_;
  hwy::AlignedFreeUniquePtr<float[]> memory_;
  float *rgb_, *planes_;
  FlipColours in_;
  FlipFiltered out_;
  std::vector<const float*> taps_;
};

}  // namespace lobelia
