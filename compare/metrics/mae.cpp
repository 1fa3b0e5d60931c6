// Mean absolute error.
//
// Source:       textbook.
// Formula:      sum |a - b| / (3 N) over the R, G and B values of all N pixels.
// Input:        scene-linear values, neither exposed nor clipped.
// Agrees with:  `idiff` ("Mean error"), to the float32 digits it prints.
// Differs:      the sum is in double.
#include <cmath>

#include "compare/metrics/metric.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kOutputs[] = {
    {"mae", Better::kLower, true, "mean absolute error of all RGB values"}};

void measure(const MetricInput& input, std::span<double> values) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(double(a[i]) - double(b[i]));
  values[0] = a.empty() ? 0 : sum / double(a.size());
}

}  // namespace

extern const Metric mae_metric;
constinit const Metric mae_metric{kOutputs, Family::kRadiance, Needs::kNothing, "textbook",
                                  measure};

}  // namespace lobelia
