#include <fmt/format.h>

#include "base/words/constants.hpp"

#include "renderer/scene/contact.hpp"

namespace lobelia {
namespace {

/// The first sphere with the point nearer to its centre than limit(sphere).
template <class Limit>
std::optional<std::size_t> holder(const Scene& scene, Vec3 point, const Limit& limit) {
  for (std::size_t k = 0; k < scene.spheres.size(); ++k)
    if (length(point - scene.spheres[k].center) < limit(scene.spheres[k])) return k;
  return std::nullopt;
}

/// Whether some part of the sphere may be in the picture, by the cone through the picture's corners.
bool may_be_seen(const Scene& scene, const CameraFrame& frame, const Sphere& sphere) {
  const Vec3 to_center = sphere.center - frame.origin;
  const double distance = length(to_center);
  if (distance <= sphere.radius + scene.camera.aperture_radius) return true;
  const double corner = std::atan(std::hypot(frame.half_width + std::abs(frame.shift_u),
                                             frame.half_height + std::abs(frame.shift_v)));
  const double widening = std::asin(std::min(1.0, sphere.radius / distance));
  // A lens sees more, by the angle that it moves the sphere.
  const double lens = std::asin(std::min(1.0, scene.camera.aperture_radius / distance));
  return std::acos(std::clamp(dot(to_center, frame.forward) / distance, -1.0, 1.0)) <=
         corner + widening + lens;
}

/// Whether a lamp that shines to one side, or in a cone, lights no point of any sphere or plane. In doubt false.
bool faces_away(const Scene& scene, const Lamp& lamp) {
  const double cutoff = lamp.spot ? lamp.spot->cutoff * kPi / 180 : kPi / 2;
  const auto may_light = [&](const Sphere& sphere) {
    const Vec3 to_center = sphere.center - lamp.position;
    const double distance = length(to_center);
    if (distance <= sphere.radius) return true;
    const double off = std::acos(std::clamp(dot(to_center, lamp.normal) / distance, -1.0, 1.0));
    return off - std::asin(sphere.radius / distance) < cutoff;
  };
  const auto may_light_plane = [&](const Plane& plane) {
    // The plane's points lie within a right angle of the way to it.
    const double height = dot(plane.point - lamp.position, plane.normal);
    const Vec3 down = height < 0 ? -plane.normal : plane.normal;
    const double off = std::acos(std::clamp(dot(down, lamp.normal), -1.0, 1.0));
    return height == 0 || off - kPi / 2 < cutoff;
  };
  return std::ranges::none_of(scene.spheres, may_light) &&
         std::ranges::none_of(scene.planes, may_light_plane);
}

}  // namespace

std::vector<std::string> remarks(const Scene& scene) {
  std::vector<std::string> found;
  if (std::ranges::all_of(scene.lights, [](const Light& l) { return is_black(strength(l)); }))
    found.push_back(scene.lights.empty() ? "the scene has no light: the picture is black"
                                         : "no light shines: the picture is black");
  const bool sky = std::ranges::any_of(scene.lights, is_environment);
  const bool area = std::ranges::any_of(scene.lights, is_area);
  if (scene.spheres.empty() && scene.planes.empty())
    found.push_back(fmt::format("the scene has no shape: the picture shows {}",
                                sky || area ? "its lights alone" : "nothing"));
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  if (const auto k = holder(scene, scene.camera.origin, inner_radius))
    found.push_back(fmt::format(
        "the camera is inside sphere {}, and does not see it: spheres have no inside", *k));
  else if (const auto on = holder(scene, scene.camera.origin, outer_radius))
    found.push_back(fmt::format(
        "the camera is on sphere {}, and does not see it: spheres have no inside", *on));
  else if (!scene.spheres.empty() && scene.planes.empty() && !sky && !area &&
           std::ranges::none_of(scene.spheres,
                                [&](const Sphere& s) { return may_be_seen(scene, frame, s); }))
    found.push_back("the camera looks away from every sphere: the picture is black");
  const auto inside_by_more = [close = closeness(scene)](const Sphere& sphere) {
    return std::min(inner_radius(sphere), sphere.radius - close);
  };
  constexpr std::size_t kMostNamed = 8;
  std::size_t hidden = 0;
  for (std::size_t l = 0; l < scene.lights.size(); ++l)
    if (const auto lamp = find_near_lamp(scene.lights[l]))
      if (const auto k = holder(scene, lamp->position, inside_by_more); k && ++hidden <= kMostNamed)
        found.push_back(fmt::format(
            "light {} is inside sphere {}, which hides it: it lights nothing outside", l, *k));
  if (!scene.spheres.empty() || !scene.planes.empty()) {
    std::size_t away = 0;
    for (std::size_t l = 0; l < scene.lights.size(); ++l) {
      const auto lamp = is_area(scene.lights[l]) ? lamp_of_same_power(scene.lights[l])
                                                 : find_near_lamp(scene.lights[l]);
      if (lamp && lamp->has_normal() && faces_away(scene, *lamp) && ++away <= kMostNamed)
        found.push_back(fmt::format("light {} faces away from every shape: it lights nothing", l));
    }
    if (away > kMostNamed)
      found.push_back(fmt::format("{} more lights face away from every shape", away - kMostNamed));
  }
  if (hidden > kMostNamed)
    found.push_back(
        fmt::format("{} more lights are inside spheres, which hide them", hidden - kMostNamed));
  return found;
}

}  // namespace lobelia
