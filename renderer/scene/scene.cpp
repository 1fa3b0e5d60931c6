#include "renderer/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
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

Rgb strength(const Light& light) {
  struct Strength {
    Rgb operator()(const DirectionalLight& l) const { return l.irradiance; }
    Rgb operator()(const PointLight& l) const { return l.intensity; }
    Rgb operator()(const SphereLight& l) const { return l.radiance; }
    Rgb operator()(const RectangleLight& l) const { return l.radiance; }
    Rgb operator()(const EnvironmentLight& l) const { return l.radiance; }
  };
  return std::visit(Strength{}, light);
}

Illumination illuminate(const Light& light, Vec3 point) {
  if (const auto* directional = std::get_if<DirectionalLight>(&light))
    return {-directional->direction, directional->irradiance,
            std::numeric_limits<double>::infinity()};
  const auto* source = std::get_if<PointLight>(&light);
  if (!source) throw Error(ExitCode::kInternal, "a light with a size has no single direction");
  const Vec3 way = source->position - point, to_light = normalize(way);
  const double towards = has_normal(*source) ? std::max(0.0, -dot(source->normal, to_light)) : 1;
  return {to_light, towards / dot(way, way) * source->intensity, length(way)};
}

std::string beyond_delta_lights(const Scene& scene) {
  std::vector<std::string_view> found;
  const auto add = [&](bool is_there, const char* what) {
    if (is_there) found.emplace_back(what);
  };
  const auto any_light = [&](auto is_kind) {
    return std::any_of(scene.lights.begin(), scene.lights.end(), is_kind);
  };
  add(any_light([](const Light& l) { return std::holds_alternative<EnvironmentLight>(l); }),
      "an environment light");
  add(any_light([](const Light& l) {
        return !is_delta(l) && !std::holds_alternative<EnvironmentLight>(l);
      }),
      "an area light");
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
