#include "renderer/scene/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "renderer/scene/contact.hpp"

namespace lobelia {
namespace {

/// The first sphere that the point is inside, by more than `margin`.
std::optional<std::size_t> holder(const Scene& scene, Vec3 point, double margin = 0) {
  for (std::size_t k = 0; k < scene.spheres.size(); ++k) {
    const Sphere& sphere = scene.spheres[k];
    const double inner = std::min(inner_radius(sphere), sphere.radius - margin);
    if (length(point - sphere.center) < inner) return k;
  }
  return std::nullopt;
}

bool is_environment(const Light& light) { return std::holds_alternative<EnvironmentLight>(light); }

/// Whether some part of the sphere may be in the picture: by the cone of the picture's corners.
bool may_be_seen(const Scene& scene, const CameraFrame& frame, const Sphere& sphere) {
  const Vec3 way = sphere.center - frame.origin;
  const double distance = length(way);
  if (distance <= sphere.radius + scene.camera.aperture_radius) return true;
  const double corner = std::atan(std::hypot(frame.half_width + std::abs(frame.shift_u),
                                             frame.half_height + std::abs(frame.shift_v)));
  const double widening = std::asin(std::min(1.0, sphere.radius / distance));
  // A lens sees a little more; as much as it moves the sphere.
  const double lens = std::asin(std::min(1.0, scene.camera.aperture_radius / distance));
  return std::acos(std::clamp(dot(way, frame.forward) / distance, -1.0, 1.0)) <=
         corner + widening + lens;
}

}  // namespace

std::vector<std::string> remarks(const Scene& scene) {
  std::vector<std::string> found;
  if (std::all_of(scene.lights.begin(), scene.lights.end(),
                  [](const Light& l) { return is_black(strength(l)); }))
    found.push_back(scene.lights.empty() ? "the scene has no light: the picture is black"
                                         : "no light shines: the picture is black");
  const bool sky = std::any_of(scene.lights.begin(), scene.lights.end(), is_environment);
  const bool lamp = std::any_of(scene.lights.begin(), scene.lights.end(),
                                [](const Light& l) { return !is_delta(l) && !is_environment(l); });
  if (scene.spheres.empty() && scene.planes.empty())
    found.push_back(fmt::format("the scene has no shape: the picture shows {}",
                                sky || lamp ? "its lights alone" : "nothing"));
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  if (const auto k = holder(scene, scene.camera.origin))
    found.push_back(fmt::format(
        "the camera is inside sphere {}, and does not see it: spheres have no inside", *k));
  else if (!scene.spheres.empty() && scene.planes.empty() && !sky && !lamp &&
           std::none_of(scene.spheres.begin(), scene.spheres.end(),
                        [&](const Sphere& s) { return may_be_seen(scene, frame, s); }))
    found.push_back("the camera looks away from every sphere: the picture is black");
  const double close = closeness(scene);
  for (std::size_t l = 0; l < scene.lights.size(); ++l)
    if (const auto* point = std::get_if<PointLight>(&scene.lights[l]))
      if (const auto k = holder(scene, point->position, close))
        found.push_back(fmt::format(
            "light {} is inside sphere {}, which hides it: it lights nothing outside", l, *k));
  return found;
}

}  // namespace lobelia
