// Differences beyond the noise, in pixels and in regions.
//
// Source:       compare/uncertainty/z_test.hpp: Student's t for each value, and for sums over squares of 2, 4, 8,
//               ... pixels and over the whole picture, with Sidak's correction for their number.
// Formula:      z.max is the largest |z|. At most the share `significance` of comparisons has a place beyond
//               z.critical by chance. A limit on these asks whether a difference was found. The noisier the
//               pictures, the fewer are found.
// Input:        scene-linear values and their noise, less the tolerance.
#include <algorithm>

#include "compare/metrics/metric.hpp"
#include "compare/uncertainty/z_test.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kZOutputs[] = {
    {"z.max", "Largest difference, in units of its noise", Unit::kPlain, Better::kLower, false,
     "largest difference in units of its noise, as a normal number",
     "As a standard normal number; beyond the critical one it is no chance."},
    {"z.max.x", "", Unit::kPlain, Better::kNeither, false,
     "column of the pixel, or of the region's first"},
    {"z.max.y", "", Unit::kPlain, Better::kNeither, false, "its row, from the top"},
    {"z.max.size", "", Unit::kPlain, Better::kNeither, false,
     "pixels a side of the region; 0 where nothing differs"},
    {"z.critical", "Critical number of the noise", Unit::kPlain, Better::kNeither, true,
     "what is beyond is no chance",
     "What as many pixels and regions as were looked at exceed by chance in few pictures alone."},
    {"z.beyond", "Pixels beyond the noise", Unit::kCount, Better::kLower, false,
     "pixels with a value beyond", "Pixels with a value that differs by more than noise explains."},
    {"z.beyond.off_edge", "Of these, away from the edges", Unit::kCount, Better::kLower, false,
     "of these, away from the edges of the scene", "Not on an edge of the scene."},
    {"z.regions", "Regions beyond the noise", Unit::kCount, Better::kLower, false,
     "regions of 2, 4, 8, ... pixels a side beyond, and patterns",
     "Squares of 2, 4, 8, ... pixels, or sums over the picture, that differ by more than noise explains."},
    {"z.open", "Pixels that noise leaves open", Unit::kCount, Better::kNeither, false,
     "pixels that are not sure to lie within the tolerance",
     "Not sure to lie within the tolerance."}};

void measure_z(const MetricInput& input, std::span<double> values) {
  const ZTest test = z_test(input);
  const double results[] = {test.largest,          double(test.x),       double(test.y),
                            double(test.size),     test.critical,        double(test.beyond),
                            double(test.off_edge), double(test.regions), double(test.open)};
  std::ranges::copy(results, values.begin());
}

}  // namespace

extern constinit const Metric z_metric{
    kZOutputs, Family::kRadiance, Needs::kNoise, "Student's t, Sidak 1967", measure_z, {}, false};

}  // namespace lobelia
