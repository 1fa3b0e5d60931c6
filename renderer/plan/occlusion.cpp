#include "renderer/plan/plan.hpp"
#include "renderer/scene/scene_format.hpp"

namespace lobelia {
namespace {

/// Makes occluders a little wider, so that rounding never rules out a grazing one.
constexpr double kWider = 1 + 1e-9;

/// An occluder must reach the tube around the line between the centres of light and receiver, as wide as the larger
/// one.
bool may_occlude(const LightBounds& light, const Sphere& receiver, const Sphere& occluder) {
  if (light.kind == LightBounds::kEverywhere) return true;
  const Vec3 to_occluder = occluder.center - receiver.center;
  Vec3 axis = light.at;
  double axis_length = kInfinity, tube = receiver.radius;
  if (light.kind == LightBounds::kBall) {
    const Vec3 offset = light.at - receiver.center;
    axis_length = length(offset);
    if (axis_length <= receiver.radius + light.radius) return true;  // they meet: rule nothing out
    axis = normalize(offset);
    tube = std::max(tube, light.radius);
  }
  const double along = std::clamp(dot(to_occluder, axis), 0.0, axis_length);
  return length(to_occluder - along * axis) <= (tube + occluder.radius) * kWider;
}

/// The height of a sphere's centre above the plane; 0 if the two meet.
double side(const Plane& plane, Vec3 center, double radius) {
  const double height = dot(center - plane.point, plane.normal);
  const double reach = radius * kWider + 1e-12 * length(center - plane.point);
  return std::abs(height) > reach ? height : 0;
}

/// The side of the plane that all of the light is on: 1 or -1; 0 if it is on both.
int side(const Plane& plane, const LightBounds& light) {
  double height = 0;
  if (light.kind == LightBounds::kBall) height = side(plane, light.at, light.radius);
  if (light.kind == LightBounds::kFar) {
    height = dot(light.at, plane.normal);
    if (std::abs(height) < 1e-12) height = 0;
  }
  return (height > 0) - (height < 0);
}

bool may_occlude(const LightBounds& light, const Sphere& receiver, const Plane& occluder) {
  const int lit = side(occluder, light);
  return lit == 0 || lit * side(occluder, receiver.center, receiver.radius) <= 0;
}

bool may_occlude(const LightBounds& light, const Plane& receiver, const Sphere& occluder) {
  const int lit = side(receiver, light);
  return lit == 0 || lit * side(receiver, occluder.center, occluder.radius) >= 0;
}

Occluders occluders_of(const Scene& scene, const LightBounds& light, std::size_t surface,
                       bool all) {
  Occluders found;
  const std::size_t spheres = scene.spheres.size();
  const bool is_sphere = surface < spheres;
  const std::size_t plane = surface - spheres;
  for (std::size_t k = 0; k < spheres; ++k) {
    if (k == surface) continue;  // a convex body shadows itself only where N.L <= 0
    if (all || (is_sphere ? may_occlude(light, scene.spheres[surface], scene.spheres[k])
                          : may_occlude(light, scene.planes[plane], scene.spheres[k])))
      found.spheres.push_back(int(k));
  }
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    if (!is_sphere && k == plane) continue;
    if (all || !is_sphere || may_occlude(light, scene.spheres[surface], scene.planes[k]))
      found.planes.push_back(int(k));
  }
  return found;
}

/// Removes a surface that the light lies on.
void leave_out(const Scene& scene, const Light& light, int surface, Occluders& occluders) {
  const int spheres = int(scene.spheres.size());
  if (surface >= spheres) {
    std::erase(occluders.planes, surface - spheres);
  } else if (std::erase(occluders.spheres, surface) > 0 || occluders.any_sphere) {
    if (const auto horizon = horizon_of(light, scene.spheres[std::size_t(surface)]))
      occluders.horizons.push_back(*horizon);
  }
}

}  // namespace

bool occluders_by_surface(const Scene& scene) {
  // As much work and memory as of the most spheres and planes under the most lights that are always summed.
  constexpr std::size_t kMostSurfaces = kMaxPairwiseSpheres + kMaxPlanes;
  const std::size_t surfaces = scene.spheres.size() + scene.planes.size();
  return scene.spheres.size() <= kMaxPairwiseSpheres &&
         scene.lights.size() * surfaces * surfaces <=
             kMaxSummedLights * kMostSurfaces * kMostSurfaces;
}

std::vector<std::vector<Occluders>> find_occluders(const Scene& scene, const Contacts& contacts,
                                                   EffectPolicy policy) {
  const bool all = policy == EffectPolicy::kAll;
  const bool by_surface = occluders_by_surface(scene);
  const std::size_t surfaces = scene.spheres.size() + scene.planes.size();
  std::vector<std::vector<Occluders>> found(scene.lights.size());
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    if (!by_surface) {
      Occluders& any = found[l].emplace_back();
      any.any_sphere = !scene.spheres.empty();
      for (std::size_t k = 0; k < scene.planes.size(); ++k) any.planes.push_back(int(k));
    } else {
      found[l].resize(surfaces);
      const LightBounds light = bounds(scene.lights[l]);
      for (std::size_t s = 0; s < surfaces; ++s) found[l][s] = occluders_of(scene, light, s, all);
    }
    for (const int touched : contacts[l])
      for (Occluders& o : found[l]) leave_out(scene, scene.lights[l], touched, o);
  }
  return found;
}

}  // namespace lobelia
