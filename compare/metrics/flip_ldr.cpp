// LDR-FLIP: the difference that a person sees when two pictures alternate on a display, 0 to 1.
//
// Source:       P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem,
//               M. D. Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proceedings
//               of the ACM on Computer Graphics and Interactive Techniques 3 (2), 2020.
// Formula:      per pixel colour^(1 - feature). colour: distance of the Hunt-adjusted Lab colours
//               after the eye's contrast filter, remapped to [0, 1]; feature: the difference in
//               edges or points of the luminance. mean and max over all pixels.
// Input:        DisplayLight (linear, clipped). The tool takes sRGB and decodes it first.
// Agrees with:  a double loop in float64 over each pixel's windows, the paper's formulas as they stand: to 3e-7 in
//               each pixel, also of pictures that hardly differ (flip_test.cpp). NVIDIA's tool, version 1.6, its
//               mean taken in double: to 1e-8 where there are features, to 1e-4 on flat pictures.
// Computed:     on SIMD registers. Processors without fused multiply-add round twice: 2e-7. The number of threads changes
//               nothing.
// Differs:      the mean is summed in double; the tool's float32 sum is wrong by percents on a
//               large picture.
//
// Why pictures are filtered in float64: an error is a power of the distance between two filtered colours, and the feature
// difference a root. In float32, as in the tool, both enlarge rounding noise: in a flat area the feature difference is
// 1e-4 instead of 0, which moves the error by up to 8e-5, and a difference of a millionth is lost. What follows the
// differences is float32.
#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/pixel_differences.hpp"
#include "compare/metrics/shared_work.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kFlipLdrOutputs[] = {
    {"flip.ldr.mean", "LDR-FLIP, mean", Unit::kPlain, Better::kLower, true, "LDR-FLIP, mean",
     "What a person notices on flipping between the two pictures: 0 nothing, 1 everything.", 0,
     false, kUnitRange},
    {"flip.ldr.max", "LDR-FLIP, largest", Unit::kPlain, Better::kLower, true,
     "LDR-FLIP, the largest of all pixels", "The pixel where a person would notice most.", 0, false,
     kUnitRange}};

void measure_flip_ldr(const MetricInput& input, std::span<double> values) {
  const auto map = shared(input, "flip.ldr", [&] {
    return flip_error_map(input.shown_a, input.shown_b, FlipFilters(input.pixels_per_degree),
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
