// A light without a size. Every light turns into lamps: they are all that the reference engines, the formulas
// per pixel and the fused kernels know.
#pragma once

#include <algorithm>
#include <limits>

#include "core/vec.hpp"

namespace lobelia {

struct Lamp {
  bool is_distant = false;  ///< parallel light, from infinitely far away
  Vec3 position;            ///< of a near lamp
  Vec3 direction;           ///< of a distant one: where its light travels, unit length
  Rgb strength;             ///< intensity, or irradiance of a distant lamp
  Vec3 normal = {};         ///< as PointLight::normal

  bool has_normal() const { return dot(normal, normal) > 0; }

  static Lamp near(Vec3 position, Rgb intensity, Vec3 normal = {}) {
    return {false, position, {}, intensity, normal};
  }
  static Lamp distant(Vec3 direction, Rgb irradiance) { return {true, {}, direction, irradiance}; }
};

/// The unit vector from a point to the lamp, the irradiance on a plane normal to that vector, and the distance.
struct Illumination {
  Vec3 to_light;
  Rgb irradiance;
  double distance = 0;  ///< infinite for a distant lamp
};

inline Illumination illuminate(const Lamp& lamp, Vec3 point) {
  if (lamp.is_distant)
    return {-lamp.direction, lamp.strength, std::numeric_limits<double>::infinity()};
  const Vec3 way = lamp.position - point, to_light = normalize(way);
  const double towards = lamp.has_normal() ? std::max(0.0, -dot(lamp.normal, to_light)) : 1;
  return {to_light, towards / dot(way, way) * lamp.strength, length(way)};
}

}  // namespace lobelia
