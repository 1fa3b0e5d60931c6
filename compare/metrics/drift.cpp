// How much too bright the picture is in the mean, with its sign.
//
// Source:       textbook (mean bias error).
// Formula:      sum (a - b) / (3 N) over the R, G and B values of all N pixels: positive where `a` is
//               too bright. Noise cancels here, a wrong normalisation does not.
// Input:        scene-linear values, neither exposed nor clipped.
// Limit:        on its size: --fail drift=0.01 asks for |drift| <= 0.01.
#include "compare/metrics/metric.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kOutputs[] = {
    {"drift", Better::kNearZero, false, "signed mean of a - b over all RGB values"}};

void measure(const MetricInput& input, std::span<double> values) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double(a[i]) - double(b[i]);
  values[0] = a.empty() ? 0 : sum / double(a.size());
}

}  // namespace

extern const Metric drift_metric;
constinit const Metric drift_metric{kOutputs, Family::kRadiance, Needs::kNothing, "textbook",
                                    measure};

}  // namespace lobelia
