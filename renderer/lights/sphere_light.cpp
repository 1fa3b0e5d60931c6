#include "renderer/lights/sphere_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/frame.hpp"

namespace lobelia {
namespace {

/// 1 - cos of the half angle of the cone that the ball fills, seen from outside.
double cone(double radius_squared, double distance_squared) {
  const double sine_squared = radius_squared / distance_squared;
  return sine_squared / (1 + std::sqrt(std::max(0.0, 1 - sine_squared)));
}

double density(double one_minus_cos) { return 1 / (2 * std::numbers::pi * one_minus_cos); }

/// Along a unit direction, to where it enters; `inside` is half of the chord, squared.
struct Entry {
  double distance, inside;
};
Entry entry(Vec3 to_center, Vec3 direction, double radius_squared) {
  const double along = dot(to_center, direction);
  const Vec3 off_axis = to_center - along * direction;
  const double inside = radius_squared - dot(off_axis, off_axis);
  return {along - std::sqrt(std::max(0.0, inside)), inside};
}

}  // namespace

LightSample sample(const SphereLight& light, Vec3 point, double u, double v) {
  const Vec3 way = light.center - point;
  const double d2 = dot(way, way), r2 = light.radius * light.radius;
  if (!(d2 > r2)) return {};
  const double widest = cone(r2, d2);
  const Vec3 to_light = about(1 / std::sqrt(d2) * way, u * widest, v);
  return {to_light, entry(way, to_light, r2).distance, density(widest), light.radiance};
}

LightHit meet(const SphereLight& light, Vec3 point, Vec3 direction) {
  const Vec3 way = light.center - point;
  const double d2 = dot(way, way), r2 = light.radius * light.radius;
  if (!(d2 > r2)) return {};
  const Entry e = entry(way, direction, r2);
  if (!(e.inside > 0 && e.distance > 0)) return {};
  return {e.distance, density(cone(r2, d2)), light.radiance};
}

}  // namespace lobelia
