// An orthonormal frame around a direction.
#pragma once

#include <cmath>
#include <numbers>

#include "base/words/vec.hpp"

namespace lobelia {

struct Tangents {
  Vec3 first, second;  ///< unit; first x second = axis. Of +y they are +x and -z
};

/// Tangents of a unit vector, without a square root, and with -z as the only special case (Duff et al. 2017).
inline Tangents tangents(Vec3 axis) {
  const double sign = std::copysign(1.0, axis.z), a = -1 / (sign + axis.z), b = axis.x * axis.y * a;
  return {{1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x},
          {b, sign + axis.y * axis.y * a, -axis.y}};
}

/// A unit vector at the angle with 1 - cos = s from the unit vector `axis`, turned about it by `v` of a full turn.
inline Vec3 about(Vec3 axis, double s, double v) {
  const Tangents t = tangents(axis);
  const double sine = std::sqrt(s * (2 - s)), turn = 2 * std::numbers::pi * v;
  return sine * std::cos(turn) * t.first + sine * std::sin(turn) * t.second + (1 - s) * axis;
}

}  // namespace lobelia
