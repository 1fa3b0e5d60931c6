// The largest error as a share of the highlight's peak.
//
// Source:       ours. A relative error per pixel explodes in the black around a highlight. An absolute
//               error means nothing without the exponent, with which the peak grows.
// Formula:      peak = max b over all RGB values of the reference (0 if none is positive).
//               max_rel_peak = max |a - b| / peak; 0 for equal pictures, otherwise infinite if the peak is 0.
// Input:        scene-linear values, neither exposed nor clipped.
#include "base/words/constants.hpp"
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kMaxRelPeakOutputs[] = {
    {"peak", "Peak", Unit::kRadiance, Better::kNeither, false,
     "brightest RGB value of the reference", "The brightest value of the reference picture."},
    {"max_rel_peak", "Largest difference, of the peak", Unit::kShare, Better::kLower, false,
     "largest error as a share of that", "The largest difference divided by the peak.", 0, false,
     ValueRange(), true}};

void measure_max_rel_peak(const MetricInput& input, std::span<double> values) {
  const double largest = value_errors(input)->largest, peak = reference_peak(input);
  values[0] = peak;
  values[1] = largest == 0 ? 0 : peak > 0 ? largest / peak : kInfinity;
}

}  // namespace

extern constinit const Metric max_rel_peak_metric{
    kMaxRelPeakOutputs,   Family::kRadiance,
    Needs::kNothing,      "ours: max_abs by the reference's peak",
    measure_max_rel_peak, kValueErrors};

}  // namespace lobelia
