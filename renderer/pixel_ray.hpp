// One ray at a time, apart from the kernels on purpose: what judges a picture is not the code that
// made it.
#pragma once

#include <optional>

#include "renderer/scene/scene.hpp"

namespace lobelia {

struct Hit {
  int sphere;
  Vec3 point, normal;
};

/// From the camera through the centre of pixel (x, y), to the film at distance 1; not normalised.
Vec3 centre_ray(const CameraFrame& frame, const Film& film, int x, int y);

/// The nearest sphere along a ray of unit direction.
std::optional<Hit> nearest_hit(const Scene& scene, Vec3 origin, Vec3 direction);

/// Whether a sphere other than the hit one stands between the hit and the light.
bool is_shadowed(const Scene& scene, const Hit& hit, const Illumination& illumination);

}  // namespace lobelia
