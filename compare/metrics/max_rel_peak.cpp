// The largest error as a share of the highlight's peak.
//
// Source:       ours. A relative error per pixel explodes in the black around a highlight, and an
//               absolute one means nothing without the exponent: the peak grows with it.
// Formula:      peak = max b over all RGB values of the reference (0 if none is positive);
//               max_rel_peak = max |a - b| / peak; 0 for equal pictures, infinite if only the peak
//               is 0.
// Input:        scene-linear values, neither exposed nor clipped.
#include <cmath>
#include <limits>

#include "compare/metrics/metric.hpp"
#include "core/image_values.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kOutputs[] = {
    {"peak", "Peak", Unit::kRadiance, Better::kNeither, false,
     "brightest RGB value of the reference", "The brightest value of the reference picture."},
    {"max_rel_peak", "Largest difference, of the peak", Unit::kShare, Better::kLower, false,
     "largest error as a share of that", "The largest difference divided by the peak."}};

void measure(const MetricInput& input, std::span<double> values) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(double(a[i]) - double(b[i])));
  const double peak = peak_value(input.b);
  values[0] = peak;
  values[1] = largest == 0 ? 0
              : peak > 0   ? largest / peak
                           : std::numeric_limits<double>::infinity();
}

}  // namespace

extern const Metric max_rel_peak_metric;
constinit const Metric max_rel_peak_metric{kOutputs, Family::kRadiance, Needs::kNothing,
                                           "ours: max_abs by the reference's peak", measure};

}  // namespace lobelia
