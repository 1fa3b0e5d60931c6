#include "studies/agreement/cases.hpp"

namespace lobelia::agreement {
namespace {

constexpr double kExponent = 30;
/// Both engines shade it by themselves.
constexpr HighlightChoice kShared{"blinn_phong_rdf", "cosine", "exact", kExponent};
/// Every engine is told it.
constexpr HighlightChoice kTold{"modified_phong", "cs16", "exact", kExponent};

Scene grey(Scene scene) {
  for (Material& material : scene.materials)
    material.specular_reflectance = material.specular_reflectance.r * kWhite;
  return scene;
}

}  // namespace

std::vector<Case> effect_cases(const Scope& scope) {
  const int size = scope.size;
  const Light sun = directional_at(50);
  const Light lamp = PointLight{{2.2, 3, 2.4}, {25, 20, 15}, normalize({-1, -1, -1})};
  std::vector<Case> cases;
  const auto add = [&](std::string_view what, const HighlightChoice& choice, Scene scene,
                       int ring_allowed) {
    cases.push_back({Group::kEffect, what, choice, false, ring_allowed, std::move(scene)});
  };
  add("planes and a checker", kShared, grey(ground_scene(kShared, {sun}, size)), kCheckerRing);
  add("lamp with a normal", kShared, grey(ground_scene(kShared, {lamp}, size)), kCheckerRing);
  Scene shadows = grey(shadow_scene(kShared, {directional_at(30), point_light({2, 4, 8})}, size));
  shadows.materials[1].highlight = highlight_of(kShared);
  add("shadows of two lights", kShared, shadows, 3);
  Scene aside = sphere_scene(kShared, {sun}, size);
  aside.camera.principal_point_offset_x = 0.2;
  aside.camera.principal_point_offset_y = -0.15;
  add("film aside", kShared, aside, 3);
  Scene fresnel = shadow_scene(kTold, {directional_at(120), point_light({2, 4, 8})}, size);
  for (Material& material : fresnel.materials) material.fresnel = Fresnel::kSchlick;
  fresnel.materials[0].specular_reflectance = {0.02, 0.5, 0};
  add("Schlick's Fresnel factor", kTold, fresnel, 3);
  add("mirrors", kShared, mirror_scene(kShared, {sun, point_light()}, size), kCheckerRing);
  add("mirrors of a highlight that an engine is told", kTold, mirror_scene(kTold, {sun}, size),
      kCheckerRing);
  add("light with a size in a mirror", kShared,
      mirror_scene(kShared, {SphereLight{{2, 2.5, 2.5}, 0.6, {20, 16, 12}}}, size), 0);
  Scene glossy = grey(ground_scene(kShared, {sun}, size));
  glossy.depth.glossy = 1;
  add("glossy inter-reflection", kShared, glossy, 0);
  return cases;
}

std::vector<SoftCase> soft_cases(const Scope& scope) {
  constexpr int kSoftSize = 24, kSmallSoftSize = 16, kConverged = 32768;
  std::vector<SoftCase> cases;
  static constexpr std::string_view kTitles[] = {"sphere light", "rectangle light and sun",
                                                 "environment",  "antialiasing",
                                                 "lens",         "all at once"};
  auto scenes =
      soft_scenes({"phong_rdf", "cosine", "exact", 24}, scope.small ? kSmallSoftSize : kSoftSize);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (scope.small && i != 0 && i != 4) continue;
    SoftCase one{kTitles[i], grey(scenes[i].scene), {}};
    // POV-Ray takes a picture with all lamps at once only where it shades every surface itself.
    one.converged = one.scene;
    // One ray a pixel is one through its centre; a renderer that samples is given a pixel that is no more.
    if (one.scene.sampler.sample_count == 1) one.converged.film.filter.radius = 1e-6;
    one.converged.sampler.sample_count = kConverged;
    cases.push_back(std::move(one));
  }
  return cases;
}

std::vector<int> soft_points(const Scope& scope) {
  return scope.small ? std::vector<int>{16, 64} : std::vector<int>{64, 256};
}

}  // namespace lobelia::agreement
