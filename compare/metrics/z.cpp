// By how much the pictures differ more than their noise, in pixels and in regions.
//
// Source:       compare/uncertainty/z_test.hpp: Student's t for each value, and for sums over squares of 2, 4, 8,
//               ... pixels, with Sidak's correction for their number.
// Formula:      z.max is the largest |z| of all; a place beyond z.critical is there by chance in as many
//               comparisons as the significance says, at most. Limits on these ask whether a difference was
//               found: the noisier the pictures, the less is.
// Input:        scene-linear values and their noise; a tolerance is taken off the differences.
#include "compare/metrics/metric.hpp"
#include "compare/uncertainty/z_test.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kOutputs[] = {
    {"z.max", Better::kLower, false,
     "largest difference in units of its noise, as a normal number"},
    {"z.max.x", Better::kNeither, false, "column of the pixel, or of the region's first"},
    {"z.max.y", Better::kNeither, false, "its row, from the top"},
    {"z.max.size", Better::kNeither, false, "pixels a side of the region; 0 where nothing differs"},
    {"z.critical", Better::kNeither, true, "what is beyond is no chance"},
    {"z.beyond", Better::kLower, false, "pixels with a value beyond"},
    {"z.beyond.off_edge", Better::kLower, false, "of these, away from the edges of the scene"},
    {"z.regions", Better::kLower, false, "regions of 2, 4, 8, ... pixels a side beyond"},
    {"z.open", Better::kNeither, false, "pixels that are not sure to lie within the tolerance"}};

void measure(const MetricInput& input, std::span<double> values) {
  const ZTest test = z_test(input);
  const double results[] = {test.largest,          double(test.x),       double(test.y),
                            double(test.size),     test.critical,        double(test.beyond),
                            double(test.off_edge), double(test.regions), double(test.open)};
  std::copy(std::begin(results), std::end(results), values.begin());
}

}  // namespace

extern const Metric z_metric;
constinit const Metric z_metric{kOutputs, Family::kRadiance, Needs::kNoise,
                                "Student's t, Sidak 1967", measure};

}  // namespace lobelia
