// Mean absolute error.
//
// Source:       textbook.
// Formula:      sum |a - b| / (3 N) over the R, G and B values of all N pixels.
// Input:        scene-linear values, neither exposed nor clipped.
// Agrees with:  `idiff` ("Mean error"), to the float32 digits it prints.
// Differs:      the sum is in double.
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kMaeOutputs[] = {
    {"mae", "Mean difference", Unit::kRadiance, Better::kLower, true,
     "mean absolute error of all RGB values",
     "Of all pixels and channels without their signs, in radiance."}};

void measure_mae(const MetricInput& input, std::span<double> values) {
  const auto errors = value_errors(input);
  values[0] = errors->mean(errors->sizes);
}

}  // namespace

extern constinit const Metric mae_metric{kMaeOutputs, Family::kRadiance, Needs::kNothing,
                                         "textbook",  measure_mae,       kValueErrors};

}  // namespace lobelia
