// Which surfaces a light lies on: the ceiling of a lamp, the body of a glowing bulb.
#pragma once

#include <optional>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// A light that is no farther than this from a surface lies on it: 1e-12 of the largest coordinate of
/// the camera, the surfaces and the lights.
double closeness(const Scene& scene);

/// Whether all of the light is that near: a point, a rectangle in its plane, a ball of light around a
/// sphere of the same size.
bool lies_on(const Light& light, const Sphere& sphere, double closeness);
bool lies_on(const Light& light, const Plane& plane, double closeness);

/// The horizon of a light on a sphere, which hides the light from all that is not above it.
struct Horizon {
  Vec3 at, up;
  bool is_below(Vec3 point) const { return !(dot(point - at, up) > 0); }
};
/// The horizon of a light on the sphere; none for one around all of it, which is seen from everywhere.
std::optional<Horizon> horizon_of(const Light& light, const Sphere& sphere);

/// By light, the surfaces that it lies on: spheres first, then planes.
using Contacts = std::vector<std::vector<int>>;
Contacts find_contacts(const Scene& scene);

}  // namespace lobelia
