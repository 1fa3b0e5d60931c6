// FLIP's steps on rows of pixels, compiled for each instruction set. Source, agreement and the reason for float64: see
// flip_ldr.cpp.
#pragma once

#include <cstddef>
#include <limits>

namespace lobelia {

struct FlipFilters;

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

/// Converts linear RGB in [0, 1], three values a pixel. `count` is a multiple of kFlipBlock.
void flip_colours(const float* rgb, const FlipColours& out, std::size_t count);

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

/// Filters a row of both pictures along, into row `slot` of the outputs. The inputs begin at the row's first column of output,
/// aligned to 64 bytes; flip_padded(radius() + 1) columns before and after the padded row may be read.
void flip_filter_along(const FlipFilters& filters, const FlipColours& a, const FlipColours& b,
                       const FlipRows& out_a, const FlipRows& out_b, std::size_t slot);

inline constexpr std::size_t kFlipBand = 8;  ///< rows that are filtered down together

/// A block of columns of a band after the contrast filters and the feature filters: first and second derivatives of y.
struct FlipFiltered {
  using Values = double[kFlipBand][kFlipBlock];
  Values y, cx, cz_1, cz_2, dx, dy, ddx, ddy;
};

/// Where the rows of a band and around it are in a block: row y of the band at offsets[radius + y]. There are kFlipBand + 2 *
/// radius offsets. `rows` of the band are wanted.
struct FlipTapsDown {
  const std::size_t* offsets;
  std::size_t radius, rows;
};

/// Filters a block of both pictures down and compares them: the logarithm to base 2 of FLIP's error of kFlipBlock pixels in
/// each row of a band, `stride` floats apart.
void flip_block_logs(const FlipFilters& filters, const FlipRows& a, const FlipRows& b,
                     std::size_t block, const FlipTapsDown& taps, float* logs, std::size_t stride);

/// Replaces logarithms by the errors.
void flip_errors_of(float* logs, std::size_t count);

}  // namespace lobelia
