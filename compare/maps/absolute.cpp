// The largest |a - b| of the three channels: where radiance differs, and by how much.
#include <algorithm>
#include <cmath>

#include "compare/maps/difference_map.hpp"

namespace lobelia {
namespace {

std::vector<float> measure(const MapInput& input) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  std::vector<float> map(input.a.pixel_count());
  for (std::size_t i = 0; i < a.size(); ++i)
    map[i / 3] = std::max(map[i / 3], std::abs(a[i] - b[i]));
  return map;
}

}  // namespace

extern const DifferenceMap absolute_map;
constinit const DifferenceMap absolute_map{"abs", "radiance", "largest |A - B| of R, G and B",
                                           false, false,      measure};

}  // namespace lobelia
