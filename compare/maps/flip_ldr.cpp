// LDR-FLIP of each pixel; formula and source in metrics/flip_ldr.cpp.
#include <algorithm>

#include "compare/maps/difference_map.hpp"
#include "compare/metrics/flip_error.hpp"

namespace lobelia {
namespace {

constexpr int kRowsAtOnce = 64;

std::vector<float> measure(const MapInput& input) {
  const FlipFilters filters(float(input.pixels_per_degree));
  std::vector<float> map;
  map.reserve(input.a.pixel_count());
  for (int row = 0; row < input.a.height(); row += kRowsAtOnce) {
    const int end = std::min(input.a.height(), row + kRowsAtOnce);
    const std::vector<float> errors =
        flip_error_rows(input.shown_a, input.shown_b, filters, row, end);
    map.insert(map.end(), errors.begin(), errors.end());
  }
  return map;
}

}  // namespace

extern const DifferenceMap flip_ldr_map;
constinit const DifferenceMap flip_ldr_map{"flip.ldr", "LDR-FLIP, 0 to 1",
                                           "what is noticed when the two are shown in turn", false,
                                           measure};

}  // namespace lobelia
