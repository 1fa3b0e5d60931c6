// CIEDE2000 of each pixel as shown; formula and source in metrics/ciede2000.cpp.
#include "compare/metrics/ciede2000.hpp"

#include "compare/maps/difference_map.hpp"

namespace lobelia {
namespace {

std::vector<float> measure(const MapInput& input) {
  std::vector<float> map(input.a.pixel_count());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Rgb a = input.shown_a.at(i), b = input.shown_b.at(i);
    if (a != b) map[i] = float(ciede2000(lab_from_display(a), lab_from_display(b)));
  }
  return map;
}

}  // namespace

extern const DifferenceMap ciede2000_map;
constinit const DifferenceMap ciede2000_map{
    "ciede2000", "CIEDE2000", "colour difference as shown, 1 is about just noticeable", false,
    measure};

}  // namespace lobelia
