#include "renderer/lobe_properties.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/system/sha256.hpp"
#include "base/words/constants.hpp"

namespace lobelia {

double lobe_angle_at(const PreparedLobe& lobe, double value) {
  double above = 0, below = kRightAngle;
  // Each step halves the interval; 80 steps are exact even for an exponent of 1e8.
  for (int step = 0; step < 80; ++step) {
    const double middle = (above + below) / 2;
    (lobe.value(versine(middle)) > value ? above : below) = middle;
  }
  return below;
}

LobeProperties measure(LobeId id, double exponent) {
  const PreparedLobe lobe = prepare(id, exponent), cosine = prepare(*find_lobe("cosine"), exponent);
  LobeProperties properties{lobe_angle_at(lobe, 0.5), lobe_angle_at(lobe, 0), 0, 0};
  // Across the peak, on the scale of a lobe with that exponent, and across the rest.
  const auto compare_at = [&](double angle) {
    const double s = versine(angle), difference = lobe.value(s) - cosine.value(s);
    properties.above_cosine = std::max(properties.above_cosine, difference);
    properties.below_cosine = std::max(properties.below_cosine, -difference);
  };
  constexpr int kPoints = 4000;
  const double near = std::min(kRightAngle, 20 / std::sqrt(exponent));
  for (int i = 0; i <= kPoints; ++i) {
    compare_at(near * i / kPoints);
    compare_at(kRightAngle * i / kPoints);
  }
  return properties;
}

std::string identifier(const LobeId& lobe) {
  const LobeInfo& about = info(lobe);
  if (lobe.formula)
    return fmt::format("{}_{}", about.name, hex(sha256(about.formula)).substr(0, 8));
  std::string name(about.name);
  std::ranges::replace(name, '.', '_');
  return name;
}

}  // namespace lobelia
