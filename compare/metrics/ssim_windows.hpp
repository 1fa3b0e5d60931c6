// The windows of SSIM, which SSIM and MS-SSIM are made of.
#pragma once

#include "compare/metrics/luma.hpp"
#include "compare/metrics/metric.hpp"

namespace lobelia {

/// Wang et al. 2004: a Gaussian of sigma 1.5 pixels, cut to 11 x 11.
inline constexpr int kSsimWindow = kSsimSide;

struct SsimMeans {
  double similarity;          ///< l c s, the SSIM of a window, mean over all windows
  double contrast_structure;  ///< c s, without the luminance term
};

/// Over all windows that lie wholly inside the picture, which has to hold one.
SsimMeans ssim_means(const LumaRows& a, const LumaRows& b);

}  // namespace lobelia
