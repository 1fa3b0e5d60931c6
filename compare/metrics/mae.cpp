// Mean absolute error.
//
// Source:       textbook.
// Formula:      sum |a - b| / (3 N) over the R, G and B values of all N pixels.
// Input:        scene-linear values, neither exposed nor clipped; with .mask only pixels inside the mask.
// Agrees with:  `idiff` ("Mean error"), to the float32 digits it prints.
// Differs:      the sum is in double.
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kMaeOutputs[] = {
    {"mae", "Mean difference", Unit::kRadiance, Better::kLower, true,
     "mean absolute error of all RGB values",
     "Of all pixels and channels without their signs, in radiance."}};
constexpr MetricOutput kMaeMaskOutputs[] = {
    {"mae.mask", "Mean difference, inside the mask", Unit::kRadiance, Better::kLower, true,
     "mean absolute error inside the mask", "Of the pixels that see a surface."}};

template <Part part>
void measure_mae(const MetricInput& input, std::span<double> values) {
  values[0] = mean_over<part>(input, [](double a, double b) { return std::abs(a - b); });
}

}  // namespace

extern constinit const Metric mae_metric{kMaeOutputs, Family::kRadiance, Needs::kNothing,
                                         "textbook", measure_mae<Part::kPicture>};

extern constinit const Metric mae_mask_metric{kMaeMaskOutputs, Family::kRadiance, Needs::kMask,
                                              "textbook", measure_mae<Part::kMask>};

}  // namespace lobelia
