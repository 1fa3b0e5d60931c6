// Peak signal-to-noise ratio, in decibels.
//
// Source:       textbook.
// Formula:      10 log10( peak^2 / mse ), peak = the brightest RGB value of the reference b, which
//               the record holds as `peak`; infinite for equal pictures, -infinite for others
//               against a reference without a positive value.
// Input:        scene-linear values, neither exposed nor clipped.
// Differs:      `idiff` ("Peak SNR") takes the brightest value of either picture, so that a picture with
//               a peak far too high is rated the better for it; theirs is ours where the reference
//               has it, else ours + 20 log10(that peak / peak). Tools for 8 bits take 255.
#include <cmath>

#include "compare/metrics/metric.hpp"
#include "compare/metrics/picture_part.hpp"
#include "core/constants.hpp"
#include "core/image_values.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kOutputs[] = {
    {"psnr", "Peak signal-to-noise ratio", Unit::kPlain, Better::kHigher, false,
     "reference's peak over rmse, in decibels",
     "In decibels, of the reference’s peak; more is better.", kInfinity}};

void measure(const MetricInput& input, std::span<double> values) {
  const double error = mean_square_error<Part::kPicture>(input), peak = peak_value(input.b);
  values[0] = error == 0 ? kInfinity : 20 * std::log10(peak) - 10 * std::log10(error);
}

}  // namespace

extern const Metric psnr_metric;
constinit const Metric psnr_metric{kOutputs, Family::kRadiance, Needs::kNothing, "textbook",
                                   measure};

}  // namespace lobelia
