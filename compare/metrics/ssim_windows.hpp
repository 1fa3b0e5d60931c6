// The windows that SSIM and MS-SSIM are made of, and the luma that they compare. Source: ssim.cpp.
#pragma once

#include <functional>
#include <vector>

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// One display-encoded channel in [0, 1]. A type of its own, so that it cannot be confused with linear light.
struct LumaPlane {
  int width = 0, height = 0;
  std::vector<float> values;

  const float* row(int y) const { return values.data() + std::size_t(y) * std::size_t(width); }
};

/// Luma row by row: a plane of a large picture would take too much memory.
struct LumaRows {
  int width = 0, height = 0;
  std::function<void(int y, float* row)> fill;  ///< may be called on many threads
};

/// Rec. 709 luma of the sRGB-encoded light (IEC 61966-2-1), not rounded to 8 bits. The shown picture must
/// outlive it.
LumaRows luma(const DisplayLight& shown);
/// The plane must outlive its rows.
LumaRows rows_of(const LumaPlane& plane);

/// Half the size, rounded up: means of 2 x 2 pixels. An odd border repeats its pixels.
LumaPlane half_size(const LumaRows& whole);

struct SsimMeans {
  double similarity;          ///< l c s, the SSIM of a window, mean over all windows
  double contrast_structure;  ///< c s, without the luminance term
};

/// Over all windows of kSsimSide pixels a side that lie wholly inside the picture, and whose middle is a pixel where
/// `region` is not 0, unless that is empty. There must be one.
SsimMeans ssim_means(const LumaRows& a, const LumaRows& b,
                     std::span<const std::uint8_t> region = {});

}  // namespace lobelia
