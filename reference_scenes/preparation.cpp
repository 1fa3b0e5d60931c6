#include "reference_scenes/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/scene/contact.hpp"

namespace lobelia {
namespace {

/// In smallest radii from the first sphere. Farther away POV-Ray's largest ray (1e7) and Cycles' float32 are not reliable.
constexpr double kMaxExtent = 1e5;

/// Whether the lamp lights nothing below it, in the unit direction -`up`.
bool faces_away(const Lamp& lamp, Vec3 up) {
  return lamp.has_normal() && dot(lamp.normal, up) > 1 - 1e-9;
}

/// Calls f(light, lamp, surface) for each near lamp and each surface that it lies on.
template <class F>
void for_lamps_on_surfaces(const Scene& scene, const F& f) {
  const Contacts contacts = find_contacts(scene);
  for (std::size_t l = 0; l < scene.lights.size(); ++l)
    if (const auto lamp = find_near_lamp(scene.lights[l]))
      for (const int surface : contacts[l]) f(l, *lamp, std::size_t(surface));
}

std::string lamp_on_sphere(const Scene& scene, bool though_it_faces_away) {
  std::string found;
  for_lamps_on_surfaces(scene, [&](std::size_t l, const Lamp& lamp, std::size_t surface) {
    if (!found.empty() || surface >= scene.spheres.size()) return;
    if (though_it_faces_away ||
        !faces_away(lamp, normalize(lamp.position - scene.spheres[surface].center)))
      found = fmt::format("light {} lies on sphere {}", l, surface);
  });
  return found;
}

/// Puts lamps back on their surfaces after the change of units.
void lay_on_surfaces(const Scene& before, Scene& scene) {
  for_lamps_on_surfaces(before, [&](std::size_t l, const Lamp&, std::size_t surface) {
    Light& light = scene.lights[l];
    Lamp lamp = lamp_of(light);
    if (surface >= scene.spheres.size()) {
      const Plane& plane = scene.planes[surface - scene.spheres.size()];
      if (lies_on(light, plane, closeness(scene))) return;
      lamp.position = lamp.position - dot(lamp.position - plane.point, plane.normal) * plane.normal;
    } else {
      const Sphere& sphere = scene.spheres[surface];
      if (lies_on(light, sphere, closeness(scene))) return;
      lamp.position = sphere.center + sphere.radius * normalize(lamp.position - sphere.center);
    }
    light = light_of(lamp);
  });
}

/// Engine units per unit of the scene.
double engine_scale(const Scene& scene) {
  if (scene.spheres.empty()) return 1;
  double smallest = kInfinity;
  for (const Sphere& sphere : scene.spheres) smallest = std::min(smallest, sphere.radius);
  // POV-Ray's absolute tolerances, such as 1e-3 for shadows, are made for spheres of about this size.
  return std::exp2(-std::floor(std::log2(smallest)));
}

}  // namespace

bool has_mirror(const Scene& scene) {
  return scene.depth.mirror > 0 && std::ranges::any_of(scene.materials, [](const Material& m) {
           return !is_black(m.mirror_reflectance);
         });
}

std::string why_not_comparable(const Scene& scene) {
  if (scene.depth.glossy > 0)
    return "light that goes on by highlights and diffuse bases is in no engine what it is here: "
           "POV-Ray gathers it for diffuse surfaces alone, and Cycles has none of the models to draw "
           "directions by (a glossy_depth of 0 is comparable)";
  if (has_mirror(scene) && !std::ranges::all_of(scene.lights, is_delta))
    return "a mirror shows a light that has a size, and the engines' lamps cannot be seen";
  if (scene.spheres.size() > kMaxSpheresByRay)
    return fmt::format(
        "the scene has {} spheres; of more than {} no edges can be told, and nothing be compared",
        scene.spheres.size(), kMaxSpheresByRay);
  return {};
}

std::string why_not_for_programs(const Scene& scene) {
  for (const Sphere& sphere : scene.spheres)
    if (length(scene.camera.origin - sphere.center) <= outer_radius(sphere))
      return "the camera is inside a sphere or on it, where engines disagree on which side is outside";
  if (extent(in_engine_units(scene)) > kMaxExtent)
    return fmt::format(
        "something is more than {} times the smallest radius away from the first sphere, which is "
        "beyond the engines' precision",
        kMaxExtent);
  return {};
}

std::string lamp_on_sphere(const Scene& scene) { return lamp_on_sphere(scene, true); }
std::string lamp_below_horizon(const Scene& scene) { return lamp_on_sphere(scene, false); }

std::string lamp_close_to_surface(const Scene& given, double distance) {
  const Scene scene = in_engine_units(given);
  const double close = closeness(scene);
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    const auto lamp = find_near_lamp(light);
    if (!lamp) continue;
    const auto found = [&](const char* what, std::size_t k) {
      return fmt::format("light {} is nearer than {:.2g} to {} {} and does not lie on it", l,
                         distance / engine_scale(given), what, k);
    };
    for (std::size_t k = 0; k < scene.spheres.size(); ++k) {
      const Sphere& sphere = scene.spheres[k];
      const Vec3 from_center = lamp->position - sphere.center;
      if (std::abs(length(from_center) - sphere.radius) < distance &&
          !lies_on(light, sphere, close) && !faces_away(*lamp, normalize(from_center)))
        return found("sphere", k);
    }
    for (std::size_t k = 0; k < scene.planes.size(); ++k) {
      const Plane& plane = scene.planes[k];
      const double height = dot(lamp->position - plane.point, plane.normal);
      if (std::abs(height) < distance && !lies_on(light, plane, close) &&
          !faces_away(*lamp, height > 0 ? plane.normal : -plane.normal))
        return found("plane", k);
    }
  }
  return {};
}

Scene in_engine_units(Scene scene) {
  const Scene given = scene;
  const double scale = engine_scale(scene);
  const Vec3 origin = scene.spheres.empty() ? Vec3{} : scene.spheres.front().center;
  const auto place = [&](Vec3 point) { return scale * (point - origin); };
  scene.camera.origin = place(scene.camera.origin);
  scene.camera.target = place(scene.camera.target);
  for (Sphere& sphere : scene.spheres) {
    sphere.center = place(sphere.center);
    sphere.radius *= scale;
  }
  for (Light& light : scene.lights)
    if (auto lamp = find_near_lamp(light)) {
      lamp->position = place(lamp->position);
      lamp->strength = scale * scale * lamp->strength;  // irradiance stays as it was
      light = light_of(*lamp);
    }
  for (Plane& plane : scene.planes) {
    plane.point = place(plane.point);
    plane.checker_size *= scale;
  }
  lay_on_surfaces(given, scene);
  if (scene.lights.empty()) scene.lights.push_back(DirectionalLight{{0, 0, -1}, {}});
  return scene;
}

double extent(const Scene& scene) {
  double farthest = std::max(1.0, length(scene.camera.origin));
  for (const Sphere& sphere : scene.spheres)
    farthest = std::max(farthest, length(sphere.center) + sphere.radius);
  for (const Light& light : scene.lights)
    if (const auto lamp = find_near_lamp(light))
      farthest = std::max(farthest, length(lamp->position));
  return farthest;
}

Image sum_of(const std::vector<Image>& passes) {
  Image sum(passes.front().width(), passes.front().height());
  for (std::size_t i = 0; i < sum.values().size(); ++i) {
    double value = 0;
    for (const Image& pass : passes) value += pass.values()[i];
    sum.values()[i] = float(value);
  }
  return sum;
}

std::string exact_text(double value) {
  if (!std::isfinite(value))
    throw Error(ExitCode::kInternal, "a number for a reference engine is not finite");
  return fmt::format("{}", value);
}

}  // namespace lobelia
