// Measures the shape of a lobe at one exponent.
#pragma once

#include <cmath>

#include "renderer/highlight.hpp"

namespace lobelia {

/// 1 - cos of an angle, without cancellation.
inline double versine(double angle) {
  const double half_sine = std::sin(angle / 2);
  return 2 * half_sine * half_sine;
}

/// The smallest angle, radians, at which the lobe is at most `value`; pi/2 if there is none below.
double lobe_angle_at(const PreparedLobe& lobe, double value);

struct LobeProperties {
  double half_width;                  ///< angle at which it falls to half, radians; pi/2 at most
  double support;                     ///< angle beyond which it is 0, radians; pi/2 at most
  double above_cosine, below_cosine;  ///< largest differences from cos^n, relative to the peak
};

LobeProperties measure(LobeId lobe, double exponent);

}  // namespace lobelia
