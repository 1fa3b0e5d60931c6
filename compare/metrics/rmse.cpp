// Root mean square error.
//
// Source:       textbook.
// Formula:      sqrt( sum (a - b)^2 / (3 N) ) over the R, G and B values of all N pixels.
// Input:        scene-linear values, neither exposed nor clipped.
// Agrees with:  `idiff` and `oiiotool --diff` ("RMS error"), to the float32 digits they print.
// Differs:      the sum is in double; a float32 sum loses a percent on a large picture.
#include <cmath>

#include "compare/metrics/metric.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kOutputs[] = {
    {"rmse", OutputKind::kError, true, "root mean square error of all RGB values"}};

void measure(const MetricInput& input, std::span<double> values) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = double(a[i]) - double(b[i]);
    sum += difference * difference;
  }
  values[0] = a.empty() ? 0 : std::sqrt(sum / double(a.size()));
}

}  // namespace

extern const Metric rmse_metric;
constinit const Metric rmse_metric{kOutputs, false, measure};

}  // namespace lobelia
