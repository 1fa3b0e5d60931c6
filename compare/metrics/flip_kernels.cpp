#include "compare/metrics/flip_kernels.hpp"

#include <algorithm>
#include <cmath>

// As in renderer/kernels/kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/flip_kernels.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "compare/metrics/flip_pixels-inl.hpp"

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(colours_lanes);
HWY_EXPORT(filter_along_lanes);
HWY_EXPORT(block_logs_lanes);
HWY_EXPORT(errors_of_lanes);

void flip_colours(const float* rgb, const FlipColours& out, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(colours_lanes)(rgb, out, count);
}

void flip_filter_along(const FlipFilters& filters, const FlipColours& a, const FlipColours& b,
                       const FlipRows& out_a, const FlipRows& out_b, std::size_t slot) {
  HWY_DYNAMIC_DISPATCH(filter_along_lanes)(filters, a, b, out_a, out_b, slot);
}

void flip_block_logs(const FlipFilters& filters, const FlipRows& a, const FlipRows& b,
                     std::size_t block, const FlipTapsDown& taps, float* logs, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(block_logs_lanes)(filters, a, b, block, taps, logs, stride);
}

void flip_errors_of(float* logs, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(errors_of_lanes)(logs, count);
}

}  // namespace lobelia
#endif  // HWY_ONCE
