#include "renderer/scene/scene.hpp"

#include "base/words/text.hpp"

namespace lobelia {

CameraFrame camera_frame(const Camera& camera, const Film& film) {
  CameraFrame frame;
  frame.origin = camera.origin;
  frame.forward = normalize(camera.target - camera.origin);
  frame.right = normalize(cross(frame.forward, camera.up));
  frame.up = cross(frame.right, frame.forward);
  frame.half_width = std::tan(camera.fov_degrees * kPi / 360);
  frame.half_height = frame.half_width * film.height / film.width;
  frame.shift_u = -2 * camera.principal_point_offset_x * frame.half_width;
  frame.shift_v = -2 * camera.principal_point_offset_y * frame.half_height;
  frame.width = film.width;
  frame.height = film.height;
  return frame;
}

namespace {

/// The distance from the sphere that rounding may give to a point on it.
double rounding_of_points(const Sphere& sphere) {
  const Vec3 c = sphere.center;
  const double reach = std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  return sphere.radius * 1e-12 + 0x1p-48 * reach;
}

}  // namespace

double inner_radius(const Sphere& sphere) {
  return std::max(0.0, sphere.radius - rounding_of_points(sphere));
}
double outer_radius(const Sphere& sphere) { return sphere.radius + rounding_of_points(sphere); }

std::string beyond_delta_lights(const Scene& scene) {
  const std::pair<bool, std::string_view> parts[] = {
      {std::ranges::any_of(scene.lights, is_environment), "an environment light"},
      {std::ranges::any_of(scene.lights, is_area), "an area light"},
      {!scene.planes.empty(), "a ground plane"},
      {std::ranges::any_of(scene.materials, is_mirror), "a mirror"},
      {scene.depth.glossy > 0, "inter-reflection"},
      {scene.camera.aperture_radius > 0, "depth of field"},
  };
  std::vector<std::string_view> found;
  for (const auto& [is_there, part] : parts)
    if (is_there) found.push_back(part);
  return join(found);
}

}  // namespace lobelia
