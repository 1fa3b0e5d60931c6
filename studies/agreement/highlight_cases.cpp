#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "studies/agreement/cases.hpp"

namespace lobelia::agreement {
namespace {

constexpr double kExponents[] = {1, 16, 64, 256, 1024, 1e5, 1e6};
constexpr double kSmallExponents[] = {16, 1024, 1e5};

struct CaseVariant {
  std::string_view lobe, normalisation;
};
/// The first has every light at every exponent, the others take turns.
constexpr CaseVariant kVariants[] = {{"cosine", "exact"},
                                     {"cosine", "paper"},
                                     {"cs16", "exact"},
                                     {"cs16", "paper"},
                                     {"schlick", "exact"},
                                     {"gauss", "exact"},
                                     {"spherical_gaussian", "exact"}};

/// Where a sphere is brightest by a light: its normal halfway between light and eye.
Vec3 highlight_place(const Sphere& sphere, const Light& light, Vec3 eye) {
  Vec3 place = sphere.center;
  for (int i = 0; i < 60; ++i) {
    const Vec3 to_light = illuminate(light, place).to_light;
    place = sphere.center + sphere.radius * normalize(to_light + normalize(eye - place));
  }
  return place;
}

Scene one_light(const HighlightChoice& choice, const Light& light, int size) {
  return sphere_scene(choice, {light}, size);
}

Scene two_coloured_lights(const HighlightChoice& choice, int size) {
  Scene scene =
      sphere_scene(choice, {directional_at(30, {1, 0.5, 0.25}), point_light({2, 4, 8})}, size);
  scene.materials[0].specular_reflectance = {0.9, 0.6, 0.3};
  return scene;
}

/// The shadow's edge goes through the middle of the first light's highlight. The highlight is grey, so that
/// POV-Ray may shade by itself.
Scene shadowed_on_a_base(const HighlightChoice& choice, int size) {
  Scene scene = two_coloured_lights(choice, size);
  scene.materials[0].specular_reflectance = 0.75 * kWhite;
  scene.materials[0].diffuse_reflectance = {0.1, 0.2, 0.4};
  const Vec3 eye = scene.camera.origin;
  const Vec3 place = highlight_place(scene.spheres[0], scene.lights[0], eye);
  const Vec3 to_light = illuminate(scene.lights[0], place).to_light;
  const Vec3 to_eye = normalize(eye - place);
  const Vec3 away = normalize(dot(to_eye, to_light) * to_light - to_eye);
  constexpr double kRadius = 0.25;
  scene.spheres.push_back({place + 0.6 * to_light + kRadius * away, kRadius, 0});
  return scene;
}

struct NamedLight {
  std::string_view name;
  Scene (*scene)(const HighlightChoice& choice, int size);
};
constexpr NamedLight kLights[] = {
    {"head-on", [](const HighlightChoice& h, int s) { return one_light(h, directional_at(0), s); }},
    {"45 degrees",
     [](const HighlightChoice& h, int s) { return one_light(h, directional_at(45), s); }},
    {"80 degrees",
     [](const HighlightChoice& h, int s) { return one_light(h, directional_at(80), s); }},
    {"120 degrees",
     [](const HighlightChoice& h, int s) { return one_light(h, directional_at(120), s); }},
    {"point light", [](const HighlightChoice& h, int s) { return one_light(h, point_light(), s); }},
    {"two coloured lights", two_coloured_lights},
    {"shadow on a diffuse base", shadowed_on_a_base},
};

/// The camera goes to kNear before the first light's highlight, on the line on which it sees it, and zooms in as
/// the lobe narrows. From afar float32 would have the place, and with it the normal, in fewer digits. Blender has
/// no lens for less than 0.37 degrees.
void look_closely(Scene& scene, double exponent) {
  constexpr double kNear = 0.5;
  Camera& camera = scene.camera;
  const Vec3 place = highlight_place(scene.spheres[0], scene.lights[0], camera.origin);
  camera.origin = place + kNear * normalize(camera.origin - place);
  camera.target = place;
  camera.fov_degrees = std::max(0.4, std::sqrt(1e5 / exponent));
}

Case highlight_case(const HighlightChoice& choice, const NamedLight& light, int size) {
  Case one{Group::kHighlight, light.name, choice, choice.exponent >= kCloseUpExponent, 3, {}};
  one.scene = light.scene(choice, size);
  if (one.close_up) look_closely(one.scene, choice.exponent);
  return one;
}

}  // namespace

std::vector<Case> highlight_cases(const Scope& scope) {
  constexpr std::size_t kTurns = 3;  // lights of the variants but the first
  std::vector<Case> cases;
  const std::span<const double> exponents =
      scope.small ? std::span<const double>(kSmallExponents) : std::span<const double>(kExponents);
  for (std::size_t m = 0; m < models().size(); ++m)
    for (std::size_t v = 0; v < std::size(kVariants); ++v)
      for (std::size_t e = 0; e < exponents.size(); ++e) {
        if (scope.small && (m + v + e) % exponents.size() != 0) continue;
        const HighlightChoice choice{models()[m].name, kVariants[v].lobe,
                                     kVariants[v].normalisation, exponents[e]};
        const std::size_t turns = scope.small ? 1 : v == 0 ? std::size(kLights) : kTurns;
        for (std::size_t t = 0; t < turns; ++t)
          cases.push_back(highlight_case(
              choice, kLights[(2 * m + v + 3 * e + 2 * t) % std::size(kLights)], scope.size));
      }
  return cases;
}

}  // namespace lobelia::agreement
