// FLIP's filters, and the rows of pixels that they go over. Source, agreement and the reason for float64: see flip_ldr.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace lobelia {

/// The middle tap of a filter, then those on one side of it. The other side mirrors them; of `edge` it has the other sign.
using FlipTaps = std::vector<double>;

/// Separable filters for one viewing distance.
struct FlipFilters {
  explicit FlipFilters(double pixels_per_degree);

  int contrast_radius, feature_radius;  ///< as defined; taps that are almost 0 are left out, or 0
  /// Contrast sensitivity: achromatic, red-green, and blue-yellow as a sum of two Gaussians, each applied in both
  /// directions.
  FlipTaps luminance, red_green, blue_yellow_1, blue_yellow_2;
  /// Feature detection: a Gaussian across and its first (edge) or second (point) derivative along.
  FlipTaps gaussian, edge, point;

  int radius() const { return std::max(contrast_radius, feature_radius); }
};

/// Rows of pixels are padded to a multiple of this number, so that no kernel has a remainder. The kernels compute
/// the padding too; its values are never used.
inline constexpr std::size_t kFlipBlock = 16;

inline constexpr std::size_t flip_padded(std::size_t count) {
  return (count + kFlipBlock - 1) / kFlipBlock * kFlipBlock;
}

/// The logarithm of no error.
inline constexpr float kNoFlip = -std::numeric_limits<float>::infinity();

/// Pixels in YCxCz, which is Lab without its cube root, so that light may be blurred. Unscaled: y is 1 for white, cx and
/// cz are x - y and y - z, exactly 0 for greys. y is also the input of the feature filters.
struct FlipColours {
  double *y, *cx, *cz;
};

/// A pixel's row filtered along, to be filtered down the columns.
enum FlipPlane {
  kFlipY,
  kFlipCx,
  kFlipCz1,
  kFlipCz2,
  kFlipSmooth,
  kFlipEdge,
  kFlipPoint,
  kFlipPlanes
};

/// Rows that have been filtered along, stored by blocks of columns: the rows of one block of one plane follow each other,
/// so that filtering down reads one short stretch of memory.
struct FlipRows {
  double* values;
  std::size_t kept;    ///< rows that there is room for
  std::size_t blocks;  ///< of kFlipBlock columns

  double* block(FlipPlane plane, std::size_t block) const {
    return values + (std::size_t(plane) * blocks + block) * kept * kFlipBlock;
  }
  static constexpr std::size_t size(std::size_t kept, std::size_t blocks) {
    return kFlipPlanes * kept * blocks * kFlipBlock;
  }
};

inline constexpr std::size_t kFlipBand = 8;  ///< rows that are filtered down together

/// A block of columns of a band after the contrast filters and the feature filters: first and second derivatives of y.
struct FlipFiltered {
  using Values = double[kFlipBand][kFlipBlock];
  Values y, cx, cz_1, cz_2, dx, dy, ddx, ddy;
};

/// Where the rows of a band and around it are in a block: row y of the band at offsets[radius + y]. There are kFlipBand +
/// 2 * radius offsets. `rows` of the band are wanted.
struct FlipTapsDown {
  const std::size_t* offsets;
  std::size_t radius, rows;
};

}  // namespace lobelia
