#include "renderer/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/text.hpp"

namespace lobelia {

CameraFrame camera_frame(const Camera& camera, const Film& film) {
  CameraFrame frame;
  frame.origin = camera.origin;
  frame.forward = normalize(camera.target - camera.origin);
  frame.right = normalize(cross(frame.forward, camera.up));
  frame.up = cross(frame.right, frame.forward);
  frame.half_width = std::tan(camera.fov_degrees * std::numbers::pi / 360);
  frame.half_height = frame.half_width * film.height / film.width;
  frame.shift_u = -2 * camera.principal_point_offset_x * frame.half_width;
  frame.shift_v = -2 * camera.principal_point_offset_y * frame.half_height;
  frame.width = film.width;
  frame.height = film.height;
  return frame;
}

namespace {

/// How far off its sphere a point of it may be by rounding.
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
  std::vector<std::string_view> found;
  const auto add = [&](bool is_there, const char* what) {
    if (is_there) found.emplace_back(what);
  };
  const auto any_light = [&](auto is_kind) {
    return std::any_of(scene.lights.begin(), scene.lights.end(), is_kind);
  };
  add(any_light(is_environment), "an environment light");
  add(any_light(is_area), "an area light");
  add(!scene.planes.empty(), "a ground plane");
  const auto any_material = [&](auto has) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), has);
  };
  add(any_material([](const Material& m) { return !is_black(m.mirror_reflectance); }), "a mirror");
  add(scene.depth.glossy > 0, "inter-reflection");
  add(scene.camera.aperture_radius > 0, "depth of field");
  return join(found);
}

}  // namespace lobelia
