#include "reference_scenes/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "renderer/pixel_ray.hpp"

namespace lobelia {
namespace {

/// Beyond this many smallest radii from the first sphere POV-Ray's largest ray (1e7) and Cycles'
/// float32 coordinates are not to be relied on.
constexpr double kMaxExtent = 1e5;

bool inside(Vec3 point, const Sphere& sphere) {
  return length(point - sphere.center) <= sphere.radius;
}

}  // namespace

bool has_mirror(const Scene& scene) {
  return scene.depth.mirror > 0 &&
         std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return !is_black(m.mirror_reflectance); });
}

std::string why_not_comparable(const Scene& scene) {
  if (scene.depth.glossy > 0)
    return "light that goes on by highlights and diffuse bases is in no engine what it is here: "
           "POV-Ray gathers it for diffuse surfaces alone, and Cycles has none of the models to draw "
           "directions by (a glossy_depth of 0 is comparable)";
  const bool sized_light = std::any_of(scene.lights.begin(), scene.lights.end(),
                                       [](const Light& l) { return !is_delta(l); });
  if (sized_light && has_mirror(scene))
    return "a mirror shows a light that has a size, and the engines' lamps cannot be seen";
  if (scene.spheres.size() > kMaxSpheresByRay)
    return fmt::format(
        "the scene has {} spheres; of more than {} no edges can be told, and nothing be compared",
        scene.spheres.size(), kMaxSpheresByRay);
  return {};
}

std::string why_not_for_programs(const Scene& scene) {
  for (const Sphere& sphere : scene.spheres)
    if (inside(scene.camera.origin, sphere))
      return "the camera is inside a sphere, where engines disagree on which side is outside";
  if (extent(in_engine_units(scene)) > kMaxExtent)
    return fmt::format(
        "something is more than {} times the smallest radius away from the first sphere, which is "
        "beyond the engines' precision",
        kMaxExtent);
  return {};
}

Scene in_engine_units(Scene scene) {
  Vec3 origin;
  double scale = 1;
  if (!scene.spheres.empty()) {
    origin = scene.spheres.front().center;
    double smallest = std::numeric_limits<double>::infinity();
    for (const Sphere& sphere : scene.spheres) smallest = std::min(smallest, sphere.radius);
    // POV-Ray ignores shadows nearer than 1e-3 and has other absolute tolerances, which are made
    // for spheres of about this size.
    scale = std::exp2(-std::floor(std::log2(smallest)));
  }
  const auto place = [&](Vec3 point) { return scale * (point - origin); };
  scene.camera.origin = place(scene.camera.origin);
  scene.camera.target = place(scene.camera.target);
  for (Sphere& sphere : scene.spheres) {
    sphere.center = place(sphere.center);
    sphere.radius *= scale;
  }
  for (Light& light : scene.lights)
    if (auto* point = std::get_if<PointLight>(&light)) {
      point->position = place(point->position);
      point->intensity = scale * scale * point->intensity;  // irradiance stays as it was
    }
  for (Plane& plane : scene.planes) {
    plane.point = place(plane.point);
    plane.checker_size *= scale;
  }
  if (scene.lights.empty()) scene.lights.push_back(DirectionalLight{{0, 0, -1}, {}});
  return scene;
}

double extent(const Scene& scene) {
  double farthest = std::max(1.0, length(scene.camera.origin));
  for (const Sphere& sphere : scene.spheres)
    farthest = std::max(farthest, length(sphere.center) + sphere.radius);
  for (const Light& light : scene.lights)
    if (const auto* point = std::get_if<PointLight>(&light))
      farthest = std::max(farthest, length(point->position));
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
