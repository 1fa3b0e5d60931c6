#include "renderer/scene/contact.hpp"

namespace lobelia {
namespace {

/// Thousands of roundings of a coordinate.
constexpr double kCloseness = 1e-12;

/// The ball that holds the light; none if it is infinitely far away.
std::optional<LightBounds> ball_of(const Light& light) {
  const LightBounds b = bounds(light);
  return b.kind == LightBounds::kBall ? std::optional(b) : std::nullopt;
}

bool lies_on(const LightBounds& ball, const Sphere& sphere, double closeness) {
  const double distance = length(ball.at - sphere.center);
  return std::abs(distance - sphere.radius) + ball.radius <= closeness ||
         (ball.is_ball && distance + std::abs(ball.radius - sphere.radius) <= closeness);
}

double reach(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

double closeness(const Scene& scene) {
  double farthest = reach(scene.camera.origin);
  for (const Sphere& s : scene.spheres) farthest = std::max(farthest, reach(s.center) + s.radius);
  for (const Plane& plane : scene.planes) farthest = std::max(farthest, reach(plane.point));
  for (const Light& light : scene.lights)
    if (const auto ball = ball_of(light))
      farthest = std::max(farthest, reach(ball->at) + ball->radius);
  return kCloseness * farthest;
}

bool lies_on(const Light& light, const Sphere& sphere, double closeness) {
  const auto ball = ball_of(light);
  return ball && lies_on(*ball, sphere, closeness);
}

bool lies_on(const Light& light, const Plane& plane, double closeness) {
  const auto ball = ball_of(light);
  return ball &&
         std::abs(dot(ball->at - plane.point, plane.normal)) + reach_along(light, plane.normal) <=
             closeness;
}

std::optional<Horizon> horizon_of(const Light& light, const Sphere& sphere) {
  const auto ball = ball_of(light);
  if (!ball || ball->radius > sphere.radius / 2) return std::nullopt;
  return Horizon{ball->at, ball->at - sphere.center};
}

Contacts find_contacts(const Scene& scene) {
  Contacts found(scene.lights.size());
  const auto is_near = [](const Light& light) { return ball_of(light).has_value(); };
  if (std::ranges::none_of(scene.lights, is_near)) return found;
  const double close = closeness(scene);
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    const auto ball = ball_of(light);
    if (!ball) continue;
    // A tight loop: there may be millions of spheres.
    for (std::size_t k = 0; k < scene.spheres.size(); ++k)
      if (lies_on(*ball, scene.spheres[k], close)) found[l].push_back(int(k));
    for (std::size_t k = 0; k < scene.planes.size(); ++k)
      if (lies_on(light, scene.planes[k], close)) found[l].push_back(int(scene.spheres.size() + k));
  }
  return found;
}

}  // namespace lobelia
