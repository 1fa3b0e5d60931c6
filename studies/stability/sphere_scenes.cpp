#include "studies/stability/sphere_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/pixel_ray.hpp"

namespace lobelia::stability {
namespace {

constexpr int kFilmSide = 33;  ///< odd, so that one ray runs along the axis

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

const Vec3 kOblique = normalize({-1, -2, -3});  ///< where the light travels

/// A sphere that fills the picture but for a seventh, seen from `from` radii away in a direction.
HardScene one_sphere(std::string name, double radius, Vec3 center, double from, Vec3 direction) {
  Scene scene;
  scene.camera.origin = center + from * radius * normalize(direction);
  scene.camera.target = center;
  scene.camera.up = {0, 1, 0};
  scene.camera.fov_degrees = 2 * degrees(std::atan(1.15 / from));
  scene.film = {kFilmSide, kFilmSide};
  scene.lights = {DirectionalLight{kOblique, {1, 1, 1}}};
  scene.materials = {{"", {}, {1, 1, 1}, {}, Fresnel::kNone}};
  scene.spheres = {{center, radius, 0}};
  return {std::move(name), std::move(scene)};
}

HardScene with_sphere(HardScene hard, std::string name, Sphere sphere) {
  hard.name = std::move(name);
  hard.scene.spheres.push_back(sphere);
  return hard;
}

HardScene with_light(HardScene hard, std::string name, Light light) {
  hard.name = std::move(name);
  hard.scene.lights = {light};
  return hard;
}

}  // namespace

std::vector<HardScene> hard_scenes() {
  const Vec3 axis{0, 0, 1}, oblique{1, 0.4, 2};
  const HardScene plain = one_sphere("radius 1", 1, {}, 5, axis);
  std::vector<HardScene> scenes{
      plain,
      one_sphere("radius 1e-6", 1e-6, {}, 5, oblique),
      one_sphere("radius 1e-6, away from the origin", 1e-6, {0.3, -0.2, 0.7}, 5, oblique),
      one_sphere("radius 1e6", 1e6, {}, 5, oblique),
      one_sphere("radius 1e6, from just above", 1e6, {}, 1.01, oblique),
      one_sphere("1e7 radii away", 1, {}, 1e7, axis),
      one_sphere("1e7 radii away, oblique", 1, {}, 1e7, oblique),
      one_sphere("1e7 radii of 1e-6 away", 1e-6, {}, 1e7, oblique),
      with_sphere(plain, "two concentric spheres", {{}, 0.5, 0}),
      with_sphere(plain, "two concentric spheres, an ulp apart", {{}, std::nextafter(1, 0), 0}),
      with_sphere(plain, "the same sphere twice", plain.scene.spheres[0]),
      with_sphere(plain, "two spheres that touch", {{0, 2, 0}, 1, 0}),
      with_light(plain, "light inside the sphere", PointLight{{0.1, 0.2, 0.3}, {1, 1, 1}}),
      with_sphere(with_light(plain, "", PointLight{{0.1, 0.2, 0.3}, {1, 1, 1}}),
                  "light inside one of two spheres", {{-0.9, 0.8, 1}, 0.2, 0}),
      with_light(plain, "light just above the surface", PointLight{{0, 0.6, 0.801}, {1, 1, 1}}),
      with_light(plain, "light at a right angle", DirectionalLight{{1, 0, 0}, {1, 1, 1}}),
      with_light(plain, "light behind the sphere, all but",
                 DirectionalLight{normalize({0, 1e-3, 1}), {1, 1, 1}}),
  };
  HardScene inside = plain;
  inside.name = "camera inside";
  inside.scene.spheres[0].radius = 10;
  scenes.push_back(inside);
  // The middle ray runs along the tangent: an ulp of the radius decides.
  for (const auto& [name, radius] :
       {std::pair("tangent ray", 1.0),
        std::pair("tangent ray, an ulp inside", std::nextafter(1, 2)),
        std::pair("tangent ray, an ulp outside", std::nextafter(1, 0))}) {
    HardScene tangent = plain;
    tangent.name = name;
    tangent.scene.spheres[0] = {{1, 0, 0}, radius, 0};
    scenes.push_back(tangent);
  }
  return scenes;
}

std::vector<Scene> close_to_highlight(Scene scene, double exponent) {
  const Sphere& sphere = scene.spheres[0];
  Vec3 normal = normalize(scene.camera.origin - sphere.center), point;
  // The distance over which the direction to the eye or the light, or the normal, changes.
  double scale = sphere.radius;
  // In small steps: just above the surface the direction changes much from point to point.
  for (int i = 0; i < 20000; ++i) {
    point = sphere.center + sphere.radius * normal;
    const Illumination light = illuminate(scene.lights[0], point);
    const Vec3 to_eye = scene.camera.origin - point;
    scale = std::min({sphere.radius, light.distance, length(to_eye)});
    const Vec3 half = normalize(light.to_light + normalize(to_eye));
    normal = normalize(normal + 0.5 * scale / sphere.radius * (half - normal));
  }
  const double distance = length(scene.camera.origin - point);
  const auto hit =
      nearest_hit(scene, scene.camera.origin, 1 / distance * (point - scene.camera.origin));
  const Vec3 to_light = illuminate(scene.lights[0], point).to_light;
  if (!hit || hit->sphere != 0 || !(dot(hit->normal, to_light) > 0.05)) return {};
  scene.camera.target = point;
  scene.camera.fov_degrees =
      2 * degrees(std::atan(std::min(1.0, 2.5 / std::sqrt(exponent)) * scale / distance));
  scene.film = {kFilmSide - 8, kFilmSide - 8};
  return {scene};
}

}  // namespace lobelia::stability
