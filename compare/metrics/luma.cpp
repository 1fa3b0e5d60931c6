#include "compare/metrics/luma.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

// As in renderer/kernels/kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/luma.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "compare/metrics/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

template <class Real>
HWY_INLINE Real encoded(Real light) {
  return where(light > 0.0031308, 1.055 * pow(light, 1 / 2.4) - 0.055, 12.92 * light);
}

}  // namespace

void luma_lanes(const float* rgb, float* out, std::size_t count) {
  for_all_pixels(count, [&](auto d, std::size_t i) HWY_ATTR {
    const auto light = load_rgb(d, rgb + 3 * i);
    const auto r = encoded(light.r), g = encoded(light.g), b = encoded(light.b);
    // A grey is the grey itself: the weights add up to 1, their rounded products do not.
    const auto is_grey = hn::And(r == g, g == b);
    store(where(is_grey, r, 0.2126 * r + 0.7152 * g + 0.0722 * b), out + i);
  });
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {
namespace {

template <class Work>
void for_each_row(int height, Work work) {
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(0, height),
                            [&](const oneapi::tbb::blocked_range<int>& rows) {
                              for (int y = rows.begin(); y < rows.end(); ++y) work(y);
                            });
}

LumaPlane empty_plane(int width, int height) {
  return {width, height, std::vector<float>(std::size_t(width) * std::size_t(height))};
}

float* row_of(LumaPlane& plane, int y) {
  return plane.values.data() + std::size_t(y) * std::size_t(plane.width);
}

}  // namespace

HWY_EXPORT(luma_lanes);

LumaRows luma(const DisplayLight& shown) {
  return {shown.width(), shown.height(), [shown](int y, float* row) {
            const auto width = std::size_t(shown.width());
            std::vector<float> rgb(3 * width);
            shown.fill(y, 0, rgb);
            HWY_DYNAMIC_DISPATCH(luma_lanes)(rgb.data(), row, width);
          }};
}

LumaRows rows_of(const LumaPlane& plane) {
  return {plane.width, plane.height,
          [&plane](int y, float* row) { std::copy_n(plane.row(y), plane.width, row); }};
}

LumaPlane plane_of(const LumaRows& rows) {
  LumaPlane plane = empty_plane(rows.width, rows.height);
  for_each_row(rows.height, [&](int y) { rows.fill(y, row_of(plane, y)); });
  return plane;
}

LumaPlane half_size(const LumaRows& whole) {
  LumaPlane result = empty_plane((whole.width + 1) / 2, (whole.height + 1) / 2);
  for_each_row(result.height, [&](int y) {
    std::vector<float> upper(std::size_t(whole.width)), lower(upper);
    whole.fill(2 * y, upper.data());
    whole.fill(std::min(2 * y + 1, whole.height - 1), lower.data());
    float* out = row_of(result, y);
    for (int x = 0; x < result.width; ++x) {
      const auto left = 2 * std::size_t(x), right = std::min(left + 1, upper.size() - 1);
      out[x] = ((upper[left] + upper[right]) + (lower[left] + lower[right])) / 4;
    }
  });
  return result;
}

}  // namespace lobelia
#endif  // HWY_ONCE
