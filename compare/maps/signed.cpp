// The mean of a - b over the three channels: which of the two is brighter.
#include "compare/maps/difference_map.hpp"

namespace lobelia {
namespace {

std::vector<float> measure(const MapInput& input) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  std::vector<float> map(input.a.pixel_count());
  for (std::size_t pixel = 0; pixel < map.size(); ++pixel) {
    double sum = 0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) sum += double(a[i]) - double(b[i]);
    map[pixel] = float(sum / 3);
  }
  return map;
}

}  // namespace

extern const DifferenceMap signed_map;
constinit const DifferenceMap signed_map{"signed", "radiance", "mean of A - B over R, G and B",
                                         true,     false,      measure};

}  // namespace lobelia
