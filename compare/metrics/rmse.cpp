// Root mean square error.
//
// Source:       textbook.
// Formula:      sqrt( sum (a - b)^2 / (3 N) ) over the R, G and B values of all N pixels.
// Input:        scene-linear values, neither exposed nor clipped.
// Agrees with:  `idiff` and `oiiotool --diff` ("RMS error"), to the float32 digits they print.
// Differs:      the sum is in double; a float32 sum loses a percent on a large picture.
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kRmseOutputs[] = {
    {"rmse", "Root mean square difference", Unit::kRadiance, Better::kLower, true,
     "root mean square error of all RGB values", "Over all pixels and channels, in radiance."}};

void measure_rmse(const MetricInput& input, std::span<double> values) {
  const auto errors = value_errors(input);
  values[0] = std::sqrt(errors->mean(errors->squares));
}

}  // namespace

extern constinit const Metric rmse_metric{kRmseOutputs, Family::kRadiance, Needs::kNothing,
                                          "textbook",   measure_rmse,      kValueErrors};

}  // namespace lobelia
