// MS-SSIM: SSIM at five scales, the coarse ones as from a greater distance; 1 for equal pictures.
//
// Source:       Z. Wang, E. P. Simoncelli, A. C. Bovik, "Multi-scale structural similarity for image
//               quality assessment", 37th Asilomar Conference on Signals, Systems and Computers, 2003,
//               eq. (7) and section 3.2.
// Formula:      (mean SSIM at scale 5)^w5 * product over scales 1 to 4 of (mean c s)^w, where scale 1
//               is the picture and each next one half of it, by means of 2 x 2 pixels; w = 0.0448,
//               0.2856, 0.3001, 0.2363, 0.1333. A mean below 0 counts as 0: it has no such power.
// Windows:      as in ssim.cpp, at each scale only those wholly inside. Fewer scales would be another
//               metric under the same name, so it is left out of the results where the fifth scale
//               would not hold a window: below 176 pixels a side.
// Input:        as ssim.
// Agrees with:  Wang's msssim.m in formula, weights, windows and halving, beyond odd borders too
//               (not run beside it); a plain double loop, to 1e-12.
#include <algorithm>
#include <cmath>

#include "compare/metrics/metric.hpp"
#include "compare/metrics/ssim_windows.hpp"

namespace lobelia {
namespace {

constexpr double kWeights[] = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
constexpr int kScales = int(std::size(kWeights));
// ceil(175 / 16) is a window too; Wang's msssim.m asks for a side / 2^4 of a window, and so do we.
static_assert(kSsimWindow << (kScales - 1) == kMsSsimSide);

constexpr MetricOutput kOutputs[] = {
    {"ms_ssim", "MS-SSIM", Unit::kPlain, Better::kHigher, true,
     "structural similarity at five scales",
     "The same at five scales, the coarse ones as from farther away.", 1, true}};

void measure(const MetricInput& input, std::span<double> values) {
  // Of the pictures themselves no plane is kept: two would be a third of the pictures.
  LumaRows rows_a = luma(input.shown_a), rows_b = luma(input.shown_b);
  LumaPlane a, b;
  double product = 1;
  for (int scale = 0;; ++scale) {
    const SsimMeans means = ssim_means(rows_a, rows_b);
    const bool last = scale == kScales - 1;
    const double mean = last ? means.similarity : means.contrast_structure;
    product *= std::pow(std::max(mean, 0.0), kWeights[scale]);
    if (last) break;
    a = half_size(rows_a);
    b = half_size(rows_b);
    rows_a = rows_of(a);
    rows_b = rows_of(b);
  }
  values[0] = product;
}

}  // namespace

extern const Metric ms_ssim_metric;
constinit const Metric ms_ssim_metric{kOutputs, Family::kStructure, Needs::kFiveScales,
                                      "Wang, Simoncelli, Bovik 2003", measure};

}  // namespace lobelia
