// Pixels with another identifier.
//
// Source:       ours.
// Formula:      pixels: the number of pixels in which an identifier differs in any bit; of a Cryptomatte, in which an
//               object that covers more than 0.1 % of the pixel is in one picture alone (compare/cryptomatte.hpp).
//               share: divided by the number of pixels.
// Input:        LayerInput::differs.
#include "compare/metrics/metric.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kIdentifierOutputs[] = {
    {"identifier.pixels", "Pixels with another identifier", Unit::kCount, Better::kLower, true,
     "pixels with another identifier"},
    {"identifier.share", "Share of pixels with another identifier", Unit::kShare, Better::kLower,
     true, "the same as a share of the pixels", "", 0, false, kUnitRange}};

void measure_identifier(const MetricInput& input, std::span<double> values) {
  std::int64_t differ = 0, count = 0;
  for (std::size_t pixel = 0; pixel < input.a.pixel_count(); ++pixel) {
    if (!input.in_region(pixel)) continue;
    ++count;
    differ += input.layer->differs[pixel] != 0;
  }
  values[0] = double(differ);
  values[1] = count > 0 ? double(differ) / double(count) : 0;
}

}  // namespace

extern constinit const Metric identifier_metric{.outputs = kIdentifierOutputs,
                                                .family = Family::kRadiance,
                                                .needs = Needs::kNothing,
                                                .source = "ours",
                                                .measure = measure_identifier,
                                                .layer = LayerType::kIdentifier};

}  // namespace lobelia
