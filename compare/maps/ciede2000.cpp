// CIEDE2000 of each pixel as shown; formula and source in metrics/ciede2000.cpp.
#include "compare/metrics/ciede2000.hpp"

#include "compare/maps/difference_map.hpp"

namespace lobelia {
namespace {

std::vector<float> measure(const MapInput& input) {
  return ciede2000_of_pixels(input.shown_a, input.shown_b).values;
}

}  // namespace

extern const DifferenceMap ciede2000_map;
constinit const DifferenceMap ciede2000_map{
    "ciede2000", "CIEDE2000", "colour difference as shown, 1 is about just noticeable",
    false,       true,        measure};

}  // namespace lobelia
