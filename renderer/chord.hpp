// One ray and one sphere in double, by the formulas of the kernels without fused multiply-adds.
#pragma once

#include <algorithm>
#include <cmath>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// The point of a ray of unit direction that is nearest to a sphere's centre, and the chord around it.
struct Chord {
  double along;
  Vec3 off_axis;
  double half_squared;  ///< the ray meets the sphere where it is positive

  double half() const { return std::sqrt(std::max(0.0, half_squared)); }
  double entry() const { return along - half(); }  ///< distance at which the ray enters
};

inline Chord chord_of(const Sphere& sphere, Vec3 origin, Vec3 direction) {
  const Vec3 to_center = sphere.center - origin;
  const double along = dot(to_center, direction);
  const Vec3 off_axis = to_center - along * direction;
  return {along, off_axis, sphere.radius * sphere.radius - dot(off_axis, off_axis)};
}

/// Whether a ray from `origin` may meet the sphere: spheres have no inside.
inline bool is_outside(const Sphere& sphere, Vec3 origin) {
  const Vec3 to_center = sphere.center - origin;
  return dot(to_center, to_center) > outer_radius(sphere) * outer_radius(sphere);
}

/// Whether a point lies in the sphere, where it is dark.
inline bool is_inside(const Sphere& sphere, Vec3 point) {
  const Vec3 to_center = sphere.center - point;
  return dot(to_center, to_center) < inner_radius(sphere) * inner_radius(sphere);
}

/// Whether the sphere is between the point and a light at `distance` in the direction `to_light`.
inline bool blocks(const Sphere& sphere, double inner_radius, Vec3 point, Vec3 to_light,
                   double distance) {
  const Chord chord = chord_of(sphere, point, to_light);
  if (!(chord.half_squared > 0)) return false;
  // Does not test the far end of the chord: for a point on this sphere it is at 0, and rounding would decide.
  const Vec3 to_center = sphere.center - point;
  const bool inside = dot(to_center, to_center) < inner_radius * inner_radius;
  return (inside || chord.along > 0) && chord.entry() < distance;
}

}  // namespace lobelia
