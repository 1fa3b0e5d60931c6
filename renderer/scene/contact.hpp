// Which surfaces a light lies on: the ceiling of a lamp, the body of a glowing bulb.
#pragma once

#include <optional>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// The distance up to which a light lies on a surface: 1e-12 of the largest coordinate of camera, surfaces and
/// lights.
double closeness(const Scene& scene);

/// Whether all of the light is that near: a point, a rectangle in the plane, a ball of light around a sphere of its
/// size.
bool lies_on(const Light& light, const Sphere& sphere, double closeness);
bool lies_on(const Light& light, const Plane& plane, double closeness);

/// The horizon of a light on a sphere. The sphere hides the light from all points that are not above it.
struct Horizon {
  Vec3 at, up;
  bool is_below(Vec3 point) const { return !(dot(point - at, up) > 0); }
};
/// None for a light around the whole sphere, which is visible from everywhere.
std::optional<Horizon> horizon_of(const Light& light, const Sphere& sphere);

/// The surfaces that each light lies on: spheres first, then planes.
using Contacts = std::vector<std::vector<int>>;
Contacts find_contacts(const Scene& scene);

}  // namespace lobelia
