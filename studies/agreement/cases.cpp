#include "studies/agreement/cases.hpp"

#include <algorithm>
#include <span>

namespace lobelia::agreement {
namespace {

constexpr double kExponents[] = {1, 16, 64, 256, 1024, 1e5, 1e6};
constexpr double kSmallExponents[] = {16, 1024, 1e5};

struct CaseVariant {
  std::string_view lobe, normalisation;
};
/// The first has every light at every exponent, the others only some.
constexpr CaseVariant kVariants[] = {{"cosine", "exact"},
                                     {"cosine", "paper"},
                                     {"cs16", "exact"},
                                     {"cs16", "paper"},
                                     {"schlick", "exact"},
                                     {"gauss", "exact"},
                                     {"spherical_gaussian", "exact"}};

/// The point of a sphere with its normal halfway between light and eye.
Vec3 highlight_place(const Sphere& sphere, const Light& light, Vec3 eye) {
  Vec3 place = sphere.center;
  for (int i = 0; i < 60; ++i) {
    const Vec3 to_light = illuminate(light, place).to_light;
    place = sphere.center + sphere.radius * normalize(to_light + normalize(eye - place));
  }
  return place;
}

template <int kDegrees>
Scene lit_at(const HighlightChoice& choice, int size) {
  return sphere_scene(choice, {directional_at(kDegrees)}, size);
}

Scene lit_by_point(const HighlightChoice& choice, int size) {
  return sphere_scene(choice, {point_light()}, size);
}

Scene two_coloured_lights(const HighlightChoice& choice, int size) {
  Scene scene =
      sphere_scene(choice, {directional_at(30, {1, 0.5, 0.25}), point_light({2, 4, 8})}, size);
  scene.materials[0].specular_reflectance = {0.9, 0.6, 0.3};
  return scene;
}

/// The shadow's edge goes through the middle of the first light's highlight. The highlight is grey, so that POV-Ray can
/// shade it natively.
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
    {"head-on", lit_at<0>},
    {"45 degrees", lit_at<45>},
    {"80 degrees", lit_at<80>},
    {"120 degrees", lit_at<120>},
    {"point light", lit_by_point},
    {"two coloured lights", two_coloured_lights},
    {"shadow on a diffuse base", shadowed_on_a_base},
};

/// Moves the camera to kNear before the first light's highlight, along its line of sight, and zooms in as the lobe
/// narrows. From farther away, float32 would round the point and so the normal more. Blender's lenses end at 0.37
/// degrees.
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

constexpr double kExponent = 30;
/// Shaded natively by both engines.
constexpr HighlightChoice kNative{"blinn_phong_rdf", "cosine", "exact", kExponent};
/// Reimplemented for every engine.
constexpr HighlightChoice kReimplemented{"modified_phong", "cs16", "exact", kExponent};

Scene grey(Scene scene) {
  for (Material& material : scene.materials)
    material.specular_reflectance = material.specular_reflectance.r * kWhite;
  return scene;
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

std::vector<Case> effect_cases(const Scope& scope) {
  const int size = scope.size;
  const Light sun = directional_at(50);
  const Light lamp = PointLight{{2.2, 3, 2.4}, {25, 20, 15}, normalize({-1, -1, -1})};
  std::vector<Case> cases;
  const auto add = [&](std::string_view what, const HighlightChoice& choice, Scene scene,
                       int ring_allowed) {
    cases.push_back({Group::kEffect, what, choice, false, ring_allowed, std::move(scene)});
  };
  // Whatever an engine has of its own, it has in one of these.
  for (const ModelInfo& model : models()) {
    const HighlightChoice choice{model.name, "cosine", "exact", kExponent};
    add("one distant light", choice, sphere_scene(choice, {sun}, size), 3);
  }
  add("planes and a checker", kNative, grey(ground_scene(kNative, {sun}, size)), kCheckerRing);
  add("lamp with a normal", kNative, grey(ground_scene(kNative, {lamp}, size)), kCheckerRing);
  const Light spot = SpotLight{{2.2, 3, 2.4}, normalize({-2, -3, -2.6}), {50, 40, 30}, 25, 8};
  add("spot", kNative, grey(ground_scene(kNative, {spot}, size)), kCheckerRing);
  Scene shadows = grey(shadow_scene(kNative, {directional_at(30), point_light({2, 4, 8})}, size));
  shadows.materials[1].highlight = highlight_of(kNative);
  add("shadows of two lights", kNative, shadows, 3);
  Scene aside = sphere_scene(kNative, {sun}, size);
  aside.camera.principal_point_offset_x = 0.2;
  aside.camera.principal_point_offset_y = -0.15;
  add("film aside", kNative, aside, 3);
  Scene fresnel = shadow_scene(kReimplemented, {directional_at(120), point_light({2, 4, 8})}, size);
  for (Material& material : fresnel.materials) material.fresnel = Fresnel::kSchlick;
  fresnel.materials[0].specular_reflectance = {0.02, 0.5, 0};
  add("Schlick's Fresnel factor", kReimplemented, fresnel, 3);
  add("mirrors", kNative, mirror_scene(kNative, {sun, point_light()}, size), kCheckerRing);
  add("mirrors of a highlight that an engine is told", kReimplemented,
      mirror_scene(kReimplemented, {sun}, size), kCheckerRing);
  add("light with a size in a mirror", kNative,
      mirror_scene(kNative, {SphereLight{{2, 2.5, 2.5}, 0.6, {20, 16, 12}}}, size), 0);
  Scene glossy = grey(ground_scene(kNative, {sun}, size));
  glossy.depth.glossy = 1;
  add("glossy inter-reflection", kNative, glossy, 0);
  return cases;
}

std::vector<SoftCase> soft_cases(const Scope& scope) {
  constexpr int kSoftSize = 24, kSmallSoftSize = 16, kConverged = 32768;
  std::vector<SoftCase> cases;
  auto scenes =
      soft_scenes({"phong_rdf", "cosine", "exact", 24}, scope.small ? kSmallSoftSize : kSoftSize);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (scope.small && i != 0 && i != 4) continue;
    SoftCase one{scenes[i].name, grey(scenes[i].scene), {}};
    one.converged = one.scene;
    // One ray a pixel goes through the centre: the same for a renderer that samples is a tiny filter.
    if (one.scene.sampler.sample_count == 1) one.converged.film.filter.radius = 1e-6;
    one.converged.sampler.sample_count = kConverged;
    cases.push_back(std::move(one));
  }
  return cases;
}

std::vector<int> soft_points(const Scope& scope) {
  // The environment, which the small scope leaves out, needs this many points. With 64, each of the 16 sets has 4
  // directions of the sky, often none of them in a highlight. The scatter is then too skewed for Student's t.
  return scope.small ? std::vector<int>{16, 64} : std::vector<int>{256, 512};
}

}  // namespace lobelia::agreement
