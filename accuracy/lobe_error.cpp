#include "accuracy/lobe_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/lobe_properties.hpp"

namespace lobelia::accuracy {

double highlight_difference(const Highlight& stand_in, const Highlight& target) {
  if (stand_in.lobe == target.lobe && stand_in.normalisation == target.normalisation) return 0;
  const PreparedLobe a = prepare(stand_in.lobe, stand_in.exponent),
                     b = prepare(target.lobe, target.exponent);
  const double ratio = radiance_coefficient(stand_in) / radiance_coefficient(target);
  const auto at = [&](double angle) {
    const double s = versine(angle);
    return std::abs(ratio * a.value(s) - b.value(s));
  };
  // Lobes end at the right angle, most of them at a value that is not 0 if n is small.
  const double end = std::nextafter(std::numbers::pi / 2, 0);
  double most = std::max(at(0), at(end));
  const auto scan = [&](double to) {
    constexpr int kPoints = 1000;
    const double step = to / kPoints;
    int best = 0;
    double there = -1;
    for (int i = 0; i <= kPoints; ++i)
      if (const double value = at(i * step); value > there) there = value, best = i;
    // Between the neighbours of the best point the difference has one maximum: thirds close in on it.
    double low = std::max(0, best - 1) * step, high = std::min(kPoints, best + 1) * step;
    for (int i = 0; i < 60; ++i) {
      const double third = (high - low) / 3;
      if (at(low + third) < at(high - third))
        low += third;
      else
        high -= third;
    }
    most = std::max({most, there, at(low), at(high)});
  };
  // Across the peak, on the scale on which a lobe of that exponent bends, and across the rest.
  scan(std::min(end, 2 / std::sqrt(target.exponent)));
  scan(std::min(end, 20 / std::sqrt(target.exponent)));
  scan(end);
  return most;
}

}  // namespace lobelia::accuracy
