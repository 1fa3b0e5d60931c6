// By how much an object of a Cryptomatte covers a pixel more or less.
//
// Source:       ours.
// Formula:      of each pixel the largest |share in a - share in b| of an object; an object that is not in a pixel has the
//               share 0. Mean and maximum over all pixels.
// Input:        LayerInput::coverage.
#include "compare/metrics/pixel_differences.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kCoverageOutputs[] = {
    {"coverage.mean", "Coverage, mean", Unit::kShare, Better::kLower, true,
     "difference of an object's coverage of a pixel, mean"},
    {"coverage.max", "Coverage, largest", Unit::kShare, Better::kLower, true,
     "difference of an object's coverage of a pixel, largest"}};

void measure_coverage(const MetricInput& input, std::span<double> values) {
  write_figures(input.layer->coverage, input, {}, values);
}

}  // namespace

extern constinit const Metric coverage_metric{.outputs = kCoverageOutputs,
                                              .family = Family::kRadiance,
                                              .needs = Needs::kCoverage,
                                              .source = "ours",
                                              .measure = measure_coverage,
                                              .layer = LayerType::kIdentifier};

}  // namespace lobelia
