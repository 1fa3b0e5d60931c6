// The largest |a - b| / |b| of the three channels: flanks and tails count as much as the peak.
#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/maps/difference_map.hpp"

namespace lobelia {
namespace {

/// Something where the reference has nothing is more than any scale, but not the NaN of a broken pixel.
constexpr float kWithoutReference = std::numeric_limits<float>::max();

std::vector<float> measure(const MapInput& input) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  std::vector<float> map(input.a.pixel_count());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::abs(double(a[i]) - double(b[i]));
    if (difference == 0) continue;
    const double relative =
        b[i] == 0 ? double(kWithoutReference) : difference / std::abs(double(b[i]));
    map[i / 3] = std::max(map[i / 3], float(std::min(relative, double(kWithoutReference))));
  }
  return map;
}

}  // namespace

extern const DifferenceMap relative_map;
constinit const DifferenceMap relative_map{
    "relative", "share of the reference", "largest |A - B| / |B| of R, G and B", false, false,
    measure};

}  // namespace lobelia
