// FLIP's steps on rows of pixels, compiled for each instruction set.
#pragma once

#include "compare/metrics/flip_filters.hpp"

namespace lobelia {

/// Converts linear RGB in [0, 1], three values a pixel. `count` is a multiple of kFlipBlock.
void flip_colours(const float* rgb, const FlipColours& out, std::size_t count);

/// Filters a row of both pictures along, into row `slot` of the outputs. The inputs begin at the row's first column of
/// output, aligned to 64 bytes; flip_padded(radius() + 1) columns before and after the padded row may be read.
void flip_filter_along(const FlipFilters& filters, const FlipColours& a, const FlipColours& b,
                       const FlipRows& out_a, const FlipRows& out_b, std::size_t slot);

/// Filters a block of both pictures down and compares them: the logarithm to base 2 of FLIP's error of kFlipBlock pixels in
/// each row of a band, `stride` floats apart.
void flip_block_logs(const FlipFilters& filters, const FlipRows& a, const FlipRows& b,
                     std::size_t block, const FlipTapsDown& taps, float* logs, std::size_t stride);

/// Replaces logarithms by the errors.
void flip_errors_of(float* logs, std::size_t count);

}  // namespace lobelia
