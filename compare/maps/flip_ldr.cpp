// LDR-FLIP of each pixel; formula and source in metrics/flip_ldr.cpp.
#include "compare/maps/difference_map.hpp"
#include "compare/metrics/flip_error.hpp"

namespace lobelia {
namespace {

std::vector<float> measure(const MapInput& input) {
  return flip_error_map(input.shown_a, input.shown_b, FlipFilters(float(input.pixels_per_degree)));
}

}  // namespace

extern const DifferenceMap flip_ldr_map;
constinit const DifferenceMap flip_ldr_map{
    "flip.ldr", "LDR-FLIP, 0 to 1", "what is noticed when the two are shown in turn", false, true,
    measure};

}  // namespace lobelia
