// SSIM: how similar the structure of two pictures is; 1 for equal pictures.
//
// Source:       Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image Quality Assessment: From
//               Error Visibility to Structural Similarity", IEEE Transactions on Image Processing 13
//               (4), 2004, eq. (13).
// Formula:      mean over windows of (2 ma mb + C1) (2 sab + C2) / ((ma^2 + mb^2 + C1) (sa^2 + sb^2 +
//               C2)); means, variances and covariance under a Gaussian of sigma 1.5 cut to 11 x 11,
//               of a population (no Bessel correction); C1 = 0.01^2, C2 = 0.03^2, as the range is 1.
// Border:       only windows wholly inside the picture, as in Wang's ssim_index.m. Not measured where a
//               side has fewer than 11 pixels.
// Input:        DisplayLight (linear, clipped), encoded by sRGB's curve; Rec. 709 luma of that, not
//               rounded to 8 bits.
// Agrees with:  grey 128 against grey 160 of 255, 0.975614, to the six published digits; a plain double
//               loop over windows, to 1e-12; with luma in double, to 1e-6.
// Differs:      Wang's ssim.m first shrinks a picture of more than 384 pixels. This one never does: ms_ssim
//               covers greater distances. scikit-image repeats pixels beyond the border and then cuts off
//               5, which is the same region. Its defaults (7 x 7 box, Bessel's correction) are not Wang's.
#include "compare/metrics/ssim_windows.hpp"

namespace lobelia {
namespace {

constexpr ValueRange kCorrelationRange{-1, 1};

constexpr MetricOutput kSsimOutputs[] = {
    {"ssim", "SSIM", Unit::kPlain, Better::kHigher, true, "structural similarity of the luma, mean",
     "How alike the structure is, 1 for equal pictures; more is better.", 1, true,
     kCorrelationRange}};

void measure_ssim(const MetricInput& input, std::span<double> values) {
  values[0] = means_of(*shown_ssim(input), input).similarity;
}

}  // namespace

extern constinit const Metric ssim_metric{kSsimOutputs,
                                          Family::kStructure,
                                          Needs::kOneWindow,
                                          "Wang, Bovik, Sheikh, Simoncelli 2004",
                                          measure_ssim,
                                          kSsimWork,
                                          true,
                                          [](const MetricInput&) { return kSsimSide / 2; }};

}  // namespace lobelia
