// The windows that SSIM and MS-SSIM are made of, and the luma that they compare. Source: ssim.cpp.
#pragma once

#include <functional>
#include <vector>

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// One display-encoded channel in [0, 1]. A type of its own, so that it cannot be confused with linear light.
struct LumaPlane {
  using Values = std::vector<float, ZeroedMemory<float>>;
  int width = 0, height = 0;
  Values values;

  const float* row(int y) const { return values.data() + std::size_t(y) * std::size_t(width); }
};

/// Luma row by row: a plane of a large picture would take too much memory.
struct LumaRows {
  int width = 0, height = 0;
  /// Writes row.size() pixels of row y, from column `first` on. May be called on many threads.
  std::function<void(int y, int first, std::span<float> row)> fill;
};

/// Rec. 709 luma of the sRGB-encoded light (IEC 61966-2-1), not rounded to 8 bits. The shown picture must
/// outlive it.
LumaRows luma(const DisplayLight& shown);
/// The plane must outlive its rows.
LumaRows rows_of(const LumaPlane& plane);

/// Means over all windows of kSsimSide pixels a side that lie wholly inside the picture, and whose middle is in a region.
struct SsimMeans {
  double similarity = 0;          ///< l c s, the SSIM of a window
  double contrast_structure = 0;  ///< c s, without the luminance term
};

/// The results of SSIM for two pictures at one scale.
struct SsimScale {
  std::vector<SsimMeans> of_region;  ///< 0 without a window
  /// The next scale, rounded up: means of 2 x 2 pixels. An odd border repeats its pixels.
  LumaPlane half_a, half_b;
};

/// Regions are not 0 at pixels inside; an empty one is the whole picture. The sides must be at least kSsimSide.
SsimScale ssim_scale(const LumaRows& a, const LumaRows& b,
                     std::span<const std::span<const std::uint8_t>> regions);

/// The scale of the pictures themselves, of the regions of input.regions or else of its own, for all metrics of
/// kSsimWork.
std::shared_ptr<const SsimScale> shown_ssim(const MetricInput& input);
/// The means of the input's region.
SsimMeans means_of(const SsimScale& scale, const MetricInput& input);
inline constexpr std::string_view kSsimWork = "ssim";

}  // namespace lobelia
