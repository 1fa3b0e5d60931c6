// The largest error, and where it is.
//
// Source:       textbook.
// Formula:      max |a - b| over the R, G and B values of all pixels; the first such pixel in
//               reading order, x to the right, y down, from 0. Equal pictures: 0 at (0, 0).
// Input:        scene-linear values, neither exposed nor clipped.
// Agrees with:  `idiff` ("Max error"), to the float32 digits it prints.
#include <cmath>

#include "compare/metrics/metric.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kOutputs[] = {
    {"max_abs", Better::kLower, true, "largest error of an RGB value"},
    {"max_abs.x", Better::kNeither, true, "its column"},
    {"max_abs.y", Better::kNeither, true, "its row, from the top"}};

void measure(const MetricInput& input, std::span<double> values) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  double largest = 0;
  std::size_t where = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(double(a[i]) - double(b[i]));
    if (difference > largest) {
      largest = difference;
      where = i / 3;
    }
  }
  const std::size_t width = std::size_t(input.a.width());
  values[0] = largest;
  values[1] = a.empty() ? 0 : double(where % width);
  values[2] = a.empty() ? 0 : double(where / width);
}

}  // namespace

extern const Metric max_abs_metric;
constinit const Metric max_abs_metric{kOutputs, Family::kRadiance, Needs::kNothing, "textbook",
                                      measure};

}  // namespace lobelia
