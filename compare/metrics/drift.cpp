// The mean difference, with its sign.
//
// Source:       textbook (mean bias error).
// Formula:      sum (a - b) / (3 N) over the R, G and B values of all N pixels. Positive where `a` is
//               too bright. Noise cancels; a wrong normalisation does not.
// Input:        scene-linear values, neither exposed nor clipped.
// Limit:        on its size: --fail drift=0.01 asks for |drift| <= 0.01.
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kDriftOutputs[] = {
    {"drift", "Mean difference, with its sign", Unit::kRadiance, Better::kNearZero, false,
     "signed mean of a - b over all RGB values",
     "Positive where ours is brighter; noise cancels here.", 0, false, kSignedRange}};

void measure_drift(const MetricInput& input, std::span<double> values) {
  const auto errors = value_errors(input);
  values[0] = errors->mean(errors->differences);
}

}  // namespace

extern constinit const Metric drift_metric{kDriftOutputs, Family::kRadiance, Needs::kNothing,
                                           "textbook",    measure_drift,     kValueErrors};

}  // namespace lobelia
