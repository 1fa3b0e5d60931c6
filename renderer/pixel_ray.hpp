// One ray at a time, apart from the kernels on purpose: what judges a picture is not the code that
// made it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "renderer/scene/scene.hpp"

namespace lobelia {

struct Hit {
  int sphere;
  Vec3 point, normal;
};

/// Every sphere is looked at for every ray: with more of them it would take hours.
inline constexpr std::size_t kMaxSpheresByRay = 1024;

/// The parts of a scene that single rays through the pixels' centres cannot show, in words; empty if there are none.
std::string beyond_single_rays(const Scene& scene);
/// Throws Error(kInput) where there is such a thing; `what`, "edges", is what was asked for.
void require_single_rays(const Scene& scene, std::string_view what);

/// From the camera through the centre of pixel (x, y), to the film at distance 1; not normalised.
Vec3 centre_ray(const CameraFrame& frame, int x, int y);

/// The nearest sphere along a ray of unit direction.
std::optional<Hit> nearest_hit(const Scene& scene, Vec3 origin, Vec3 direction);

/// Calls visit(i, hit, to_eye) for every pixel, i in reading order, whose centre sees `sphere`.
void for_each_pixel_of(
    const Scene& scene, int sphere,
    const std::function<void(std::size_t i, const Hit& hit, Vec3 to_eye)>& visit);

/// The light from a directional or point light at a point of a sphere. Nothing if it is below the horizon or hidden by
/// another sphere. (A sphere hides a lamp that lies on it below the lamp's horizon.)
std::optional<Illumination> light_at(const Scene& scene, int light, const Hit& hit);

}  // namespace lobelia
