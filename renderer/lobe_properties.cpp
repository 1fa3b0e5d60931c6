#include "renderer/lobe_properties.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lobelia {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

double one_minus_cos(double angle) {
  const double half_sine = std::sin(angle / 2);
  return 2 * half_sine * half_sine;
}

/// The smallest angle at which the lobe is at most `value`; pi/2 if there is none before.
double angle_of(LobeId lobe, double exponent, double value) {
  double above = 0, below = kRightAngle;
  // Each step halves the interval; 80 leave an exponent of 1e8 its digits too.
  for (int step = 0; step < 80; ++step) {
    const double middle = (above + below) / 2;
    (lobe_value(lobe, one_minus_cos(middle), exponent) > value ? above : below) = middle;
  }
  return below;
}

}  // namespace

LobeProperties measure(LobeId lobe, double exponent) {
  LobeProperties properties{angle_of(lobe, exponent, 0.5), angle_of(lobe, exponent, 0), 0, 0};
  const LobeId cosine = *find_lobe("cosine");
  // Across the peak, on the scale on which a lobe of that exponent bends, and across the rest.
  const auto compare_at = [&](double angle) {
    const double s = one_minus_cos(angle);
    const double difference = lobe_value(lobe, s, exponent) - lobe_value(cosine, s, exponent);
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

}  // namespace lobelia
