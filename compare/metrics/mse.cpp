// Mean square error.
//
// Source:       textbook.
// Formula:      sum (a - b)^2 / (3 N) over the R, G and B values of all N pixels; rmse is its root.
// Input:        scene-linear values, neither exposed nor clipped.
// Agrees with:  the square of the "RMS error" of `idiff`, to the float32 digits it prints.
// Differs:      the sum is in double.
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kMseOutputs[] = {
    {"mse", "Mean square difference", Unit::kPlain, Better::kLower, true,
     "mean square error of all RGB values", "The square of the root mean square difference.", 0,
     true}};

void measure_mse(const MetricInput& input, std::span<double> values) {
  const auto errors = value_errors(input);
  values[0] = errors->mean(errors->squares);
}

}  // namespace

extern constinit const Metric mse_metric{kMseOutputs, Family::kRadiance, Needs::kNothing,
                                         "textbook",  measure_mse,       kValueErrors};

}  // namespace lobelia
