// FLIP's steps on rows of pixels, compiled for each instruction set. Source, agreement and the reason for float: see
// flip_ldr.cpp.
#pragma once

#include <cstddef>
#include <span>

namespace lobelia {

/// Rows of pixels are padded to a multiple of this number, so that no kernel has a remainder. The kernels compute
/// the padding too; its values are never used.
inline constexpr std::size_t kFlipBlock = 16;

inline constexpr std::size_t flip_padded(std::size_t count) {
  return (count + kFlipBlock - 1) / kFlipBlock * kFlipBlock;
}

/// Pixels in YCxCz: Lab without its cube root, so that light may be blurred. y is 100 for white. grey is y scaled
/// to [0, 1], the input of the feature filters.
struct FlipColours {
  float *y, *cx, *cz, *grey;
};

/// Converts linear RGB in [0, 1], three values a pixel, to YCxCz. `count` is a multiple of kFlipBlock.
void flip_colours(const float* rgb, const FlipColours& out, std::size_t count);

struct WeightedSum {
  std::span<const float> weights;
  float* out;
};

/// Filters rows: out[i] = sum over k of weights[k] * rows[k][i], i < size. One to three sums with equally many
/// weights share each load of a value. Products and sums are rounded separately and added in the order of k, which
/// gives the same bits on every processor.
void weighted_sums(std::span<const WeightedSum> sums, const float* const* rows, std::size_t size);

/// Pixels after the contrast filters (cz is the sum of two) and the feature filters: first and second derivatives
/// of the grey.
struct FlipFiltered {
  float *y, *cx, *cz_1, *cz_2, *dx, *dy, *ddx, *ddy;
};

/// FLIP's error of each of `count` pixels, in [0, 1]. `count` is a multiple of kFlipBlock.
void flip_errors(const FlipFiltered& a, const FlipFiltered& b, float* errors, std::size_t count);

}  // namespace lobelia
