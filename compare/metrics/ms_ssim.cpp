// MS-SSIM: SSIM at five scales, the coarse ones as from a greater distance; 1 for equal pictures.
//
// Source:       Z. Wang, E. P. Simoncelli, A. C. Bovik, "Multi-scale structural similarity for image
//               quality assessment", 37th Asilomar Conference on Signals, Systems and Computers, 2003,
//               eq. (7) and section 3.2.
// Formula:      (mean SSIM at scale 5)^w5 * product over scales 1 to 4 of (mean c s)^w, where scale 1
//               is the picture and each next one has half its size, by means of 2 x 2 pixels;
//               w = 0.0448, 0.2856, 0.3001, 0.2363, 0.1333. A mean below 0 has no such power and counts as 0.
// Windows:      as in ssim.cpp, at each scale only those wholly inside. Fewer scales would be another
//               metric under the same name. So it is not measured below 176 pixels a side, where the
//               fifth scale holds no window.
// Input:        as ssim.
// Regions:      none: a window of the fifth scale is 176 pixels wide, more than most highlights.
// Agrees with:  Wang's msssim.m in formula, weights, windows and halving, beyond odd borders too
//               (not run for comparison); a plain double loop, to 1e-12.
#include <algorithm>
#include <cmath>

#include "compare/metrics/ssim_windows.hpp"

namespace lobelia {
namespace {

constexpr double kScaleWeights[] = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
constexpr int kScales = int(std::size(kScaleWeights));
// ceil(175 / 16) would hold a window too; Wang's msssim.m requires side / 2^4 to hold one, and so do we.
static_assert(kSsimSide << (kScales - 1) == kMsSsimSide);

constexpr MetricOutput kMsSsimOutputs[] = {
    {"ms_ssim", "MS-SSIM", Unit::kPlain, Better::kHigher, true,
     "structural similarity at five scales",
     "The same at five scales, the coarse ones as from farther away.", 1, true, kUnitRange}};

void measure_ms_ssim(const MetricInput& input, std::span<double> values) {
  auto scale = shown_ssim(input);
  SsimMeans means = means_of(*scale, input);
  double product = 1;
  for (int i = 0; i < kScales - 1; ++i) {
    product *= std::pow(std::max(means.contrast_structure, 0.0), kScaleWeights[i]);
    const std::span<const std::uint8_t> whole;
    scale = std::make_shared<const SsimScale>(
        ssim_scale(rows_of(scale->half_a), rows_of(scale->half_b), {&whole, 1}));
    means = scale->of_region[0];
  }
  values[0] = product * std::pow(std::max(means.similarity, 0.0), kScaleWeights[kScales - 1]);
}

}  // namespace

extern constinit const Metric ms_ssim_metric{kMsSsimOutputs,
                                             Family::kStructure,
                                             Needs::kFiveScales,
                                             "Wang, Simoncelli, Bovik 2003",
                                             measure_ms_ssim,
                                             kSsimWork,
                                             false};

}  // namespace lobelia
