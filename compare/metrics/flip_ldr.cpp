// LDR-FLIP: the difference that a person sees when two pictures alternate on a display, 0 to 1.
//
// Source:       P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem,
//               M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proceedings
//               of the ACM on Computer Graphics and Interactive Techniques 3 (2), 2020.
// Formula:      per pixel colour^(1 - feature). colour: distance of the Hunt-adjusted Lab colours
//               after the eye's contrast filter, remapped to [0, 1]; feature: the difference in
//               edges or points of the luminance. mean and max over all pixels.
// Input:        DisplayLight (linear, clipped). The tool takes sRGB and decodes it first.
// Agrees with:  NVIDIA's tool, version 1.6, built without fused multiply-add, its mean taken in
//               double: all nine digits of mean and maximum on the pictures of the test. A double loop
//               in double over each pixel's windows: to 4e-6 in each pixel.
// Computed:     on SIMD registers; all instruction sets agree within 1.2e-7 (flip_kernels.cpp).
// Differs:      the mean is summed in double; the tool's float32 sum is wrong by percents on a
//               large picture.
//
// Why the error map is float32, unlike all other metrics: in a flat area the feature difference is the
// square root of rounding noise, about 1e-4 in the tool. It moves the error by up to 5e-5. More
// precision would remove the noise, and the agreement with it.
#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/pixel_differences.hpp"
#include "compare/metrics/shared_work.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kFlipLdrOutputs[] = {
    {"flip.ldr.mean", "LDR-FLIP, mean", Unit::kPlain, Better::kLower, true, "LDR-FLIP, mean",
     "What a person notices on flipping between the two pictures: 0 nothing, 1 everything."},
    {"flip.ldr.max", "LDR-FLIP, largest", Unit::kPlain, Better::kLower, true,
     "LDR-FLIP, the largest of all pixels", "The pixel where a person would notice most."}};

void measure_flip_ldr(const MetricInput& input, std::span<double> values) {
  const auto map = shared(input, "flip.ldr", [&] {
    return flip_error_map(input.shown_a, input.shown_b, FlipFilters(float(input.pixels_per_degree)),
                          input.needed());
  });
  write_figures(*map, input, {}, values);
}

}  // namespace

extern constinit const Metric flip_ldr_metric{kFlipLdrOutputs,
                                              Family::kVisibility,
                                              Needs::kNothing,
                                              "Andersson et al. 2020; FLIP 1.6",
                                              measure_flip_ldr,
                                              "flip.ldr",
                                              true,
                                              flip_radius};

}  // namespace lobelia
