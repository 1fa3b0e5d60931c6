#include "renderer/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lobelia {

CameraFrame camera_frame(const Camera& camera, const Film& film) {
  CameraFrame frame;
  frame.origin = camera.origin;
  frame.forward = normalize(camera.target - camera.origin);
  frame.right = normalize(cross(frame.forward, camera.up));
  frame.up = cross(frame.right, frame.forward);
  frame.half_width = std::tan(camera.fov_degrees * std::numbers::pi / 360);
  frame.half_height = frame.half_width * film.height / film.width;
  return frame;
}

double inner_radius(const Sphere& sphere) {
  const Vec3 c = sphere.center;
  const double reach = std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  return std::max(0.0, sphere.radius * (1 - 1e-12) - 0x1p-48 * reach);
}

Illumination illuminate(const Light& light, Vec3 point) {
  if (const auto* directional = std::get_if<DirectionalLight>(&light))
    return {-directional->direction, directional->irradiance,
            std::numeric_limits<double>::infinity()};
  const auto& source = std::get<PointLight>(light);
  const Vec3 way = source.position - point;
  return {normalize(way), 1 / dot(way, way) * source.intensity, length(way)};
}

}  // namespace lobelia
