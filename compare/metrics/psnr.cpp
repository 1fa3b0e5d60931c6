// Peak signal-to-noise ratio, in decibels.
//
// Source:       textbook.
// Formula:      10 log10( peak^2 / mse ). peak is the brightest RGB value of the reference b, `peak` in
//               the record. Infinite for equal pictures; otherwise -infinite for a reference without a
//               positive value.
// Input:        scene-linear values, neither exposed nor clipped.
// Differs:      `idiff` ("Peak SNR") takes the brightest value of either picture, which rewards a peak that
//               is far too high. Its value is ours if the reference has the higher peak, otherwise
//               ours + 20 log10(the other peak / peak). 8-bit tools take 255.
#include "base/words/constants.hpp"
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kPsnrOutputs[] = {
    {"psnr", "Peak signal-to-noise ratio", Unit::kPlain, Better::kHigher, false,
     "reference's peak over rmse, in decibels",
     "In decibels, of the reference’s peak; more is better.", kInfinity, false, kSignedRange}};

void measure_psnr(const MetricInput& input, std::span<double> values) {
  const auto errors = value_errors(input);
  const double error = errors->mean(errors->squares), peak = reference_peak(input);
  values[0] = error == 0 ? kInfinity : 20 * std::log10(peak) - 10 * std::log10(error);
}

}  // namespace

extern constinit const Metric psnr_metric{kPsnrOutputs, Family::kRadiance, Needs::kNothing,
                                          "textbook",   measure_psnr,      kValueErrors};

}  // namespace lobelia
