// FLIP's steps on rows of pixels, compiled for each instruction set. Source, agreement and why float: see
// flip_ldr.cpp.
#pragma once

#include <cstddef>

namespace lobelia {

/// Rows of pixels are padded to a multiple of so many, so that no kernel has a remainder; what lies beyond
/// the picture's pixels is computed and not looked at.
inline constexpr std::size_t kFlipBlock = 16;

inline constexpr std::size_t flip_padded(std::size_t count) {
  return (count + kFlipBlock - 1) / kFlipBlock * kFlipBlock;
}

/// Pixels in YCxCz: Lab without its cube root, in which light may be blurred. y is 100 for white; grey is
/// the same from 0 to 1, in which features are looked for.
struct FlipColours {
  float *y, *cx, *cz, *grey;
};

/// Linear RGB in [0, 1], three values a pixel, to `count` pixels in YCxCz; count a multiple of kFlipBlock.
void flip_colours(const float* rgb, const FlipColours& out, std::size_t count);

/// Pixels after the contrast filters (cz as the sum of two) and the feature filters: the first derivatives
/// of the grey and the second ones.
struct FlipFiltered {
  float *y, *cx, *cz_1, *cz_2, *dx, *dy, *ddx, *ddy;
};

/// FLIP's error of each of `count` pixels, in [0, 1]; count a multiple of kFlipBlock.
void flip_errors(const FlipFiltered& a, const FlipFiltered& b, float* errors, std::size_t count);

}  // namespace lobelia
