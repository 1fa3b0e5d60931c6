// The largest error, and where it is.
//
// Source:       textbook.
// Formula:      max |a - b| over the R, G and B values of all pixels, and the first such pixel in
//               reading order: x to the right, y down, from 0. Equal pictures: 0 at (0, 0).
// Input:        scene-linear values, neither exposed nor clipped.
// Agrees with:  `idiff` ("Max error"), to the float32 digits it prints.
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kMaxAbsOutputs[] = {
    {"max_abs", "Largest difference", Unit::kRadiance, Better::kLower, true,
     "largest error of an RGB value",
     "Of any channel of any pixel, in radiance; and at which pixel.", 0, false, ValueRange(), true},
    {"max_abs.x", "", Unit::kPlain, Better::kNeither, true, "its column"},
    {"max_abs.y", "", Unit::kPlain, Better::kNeither, true, "its row, from the top"}};

void measure_max_abs(const MetricInput& input, std::span<double> values) {
  const auto errors = value_errors(input);
  const std::size_t width = std::size_t(std::max(input.a.width(), 1));
  values[0] = errors->largest;
  values[1] = double(errors->where % width);
  values[2] = double(errors->where / width);
}

}  // namespace

extern constinit const Metric max_abs_metric{kMaxAbsOutputs, Family::kRadiance, Needs::kNothing,
                                             "textbook",     measure_max_abs,   kValueErrors};

}  // namespace lobelia
