#include "renderer/scene/contact.hpp"

#include <algorithm>
#include <cmath>

namespace lobelia {
namespace {

/// Thousands of roundings of a coordinate, so that none decides.
constexpr double kCloseness = 1e-12;

/// A ball that holds the light; none where it is infinitely far away.
struct Ball {
  Vec3 center;
  double radius = 0;
  bool is_all = false;  ///< the light is the ball

  bool lies_on(const Sphere& sphere, double closeness) const {
    const double distance = length(center - sphere.center);
    return std::abs(distance - sphere.radius) + radius <= closeness ||
           (is_all && distance + std::abs(radius - sphere.radius) <= closeness);
  }
};
std::optional<Ball> ball_of(const Light& light) {
  if (const auto* point = std::get_if<PointLight>(&light)) return Ball{point->position};
  if (const auto* ball = std::get_if<SphereLight>(&light))
    return Ball{ball->center, ball->radius, true};
  if (const auto* r = std::get_if<RectangleLight>(&light))
    return Ball{r->center, length(r->half_u + r->half_v)};
  return std::nullopt;
}

double reach(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

double closeness(const Scene& scene) {
  double farthest = reach(scene.camera.origin);
  for (const Sphere& s : scene.spheres) farthest = std::max(farthest, reach(s.center) + s.radius);
  for (const Plane& plane : scene.planes) farthest = std::max(farthest, reach(plane.point));
  for (const Light& light : scene.lights)
    if (const auto ball = ball_of(light))
      farthest = std::max(farthest, reach(ball->center) + ball->radius);
  return kCloseness * farthest;
}

bool lies_on(const Light& light, const Sphere& sphere, double closeness) {
  const auto ball = ball_of(light);
  return ball && ball->lies_on(sphere, closeness);
}

bool lies_on(const Light& light, const Plane& plane, double closeness) {
  const auto height = [&](Vec3 way) { return std::abs(dot(way, plane.normal)); };
  if (const auto* r = std::get_if<RectangleLight>(&light))
    return height(r->center - plane.point) + height(r->half_u) + height(r->half_v) <= closeness;
  const auto ball = ball_of(light);
  return ball && height(ball->center - plane.point) + ball->radius <= closeness;
}

std::optional<Horizon> horizon_of(const Light& light, const Sphere& sphere) {
  const auto ball = ball_of(light);
  if (!ball || ball->radius > sphere.radius / 2) return std::nullopt;
  return Horizon{ball->center, ball->center - sphere.center};
}

Contacts find_contacts(const Scene& scene) {
  Contacts found(scene.lights.size());
  const auto is_near = [](const Light& light) { return ball_of(light).has_value(); };
  if (std::none_of(scene.lights.begin(), scene.lights.end(), is_near)) return found;
  const double close = closeness(scene);
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    const auto ball = ball_of(light);
    if (!ball) continue;
    // In a loop that is tight: there may be millions of spheres.
    for (std::size_t k = 0; k < scene.spheres.size(); ++k)
      if (ball->lies_on(scene.spheres[k], close)) found[l].push_back(int(k));
    for (std::size_t k = 0; k < scene.planes.size(); ++k)
      if (lies_on(light, scene.planes[k], close)) found[l].push_back(int(scene.spheres.size() + k));
  }
  return found;
}

}  // namespace lobelia
