#include "studies/cost/benchmarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/plan/effects/catalogue.hpp"
#include "renderer/render.hpp"
#include "studies/cost/convergence.hpp"
#include "studies/cost/scenes.hpp"

namespace lobelia::cost {
namespace {

using ::testing::HasSubstr;

constexpr EffectPolicy kAsCalledFor = EffectPolicy::kAsCalledFor;

std::vector<std::string> effects_that_are(bool on, const Plan& plan) {
  std::vector<std::string> names;
  for (const EffectDecision& effect : plan.effects)
    if (effect.on == on) names.emplace_back(effect.name);
  return names;
}

Scene small(Scene scene) {
  scene.film = {24, 24};
  scene.sampler.sample_count = 4;
  return scene;
}

RenderResult picture(const Without& what) {
  RenderOptions options;
  options.experiment = what.experiment;
  return render(what.scene, options);
}

/// One matt sphere in parallel light, one ray a pixel.
Scene plain() {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 28};
  scene.film = {24, 24};
  scene.materials.resize(1);
  scene.materials[0].specular_reflectance = {1, 1, 1};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  scene.lights = {DirectionalLight{normalize({-0.3, -0.8, -0.6}), {3, 3, 3}}};
  return scene;
}

TEST(LeavingOut, CostsThatEffectsWorkAndChangesThePicture) {
  const Scene scene = small(everything());
  const RenderResult all = render(scene, {});
  for (std::size_t i = 0; i < all.plan.effects.size(); ++i) {
    const std::string name(all.plan.effects[i].name);
    const RenderResult left = picture(without(name, scene));
    EXPECT_GT(all.work.of_effect[i], 0u) << "the scene with everything calls for " << name;
    EXPECT_EQ(left.work.of_effect[i], 0u) << name;
    EXPECT_NE(in_place_of(name), "") << name;
    EXPECT_FALSE(std::ranges::equal(all.image.values(), left.image.values())) << name;
  }
}

TEST(LeavingOut, CostsNothingAndChangesNothingForAnEffectThatIsOff) {
  const RenderResult all = render(plain(), {});
  const auto off = effects_that_are(false, all.plan);
  EXPECT_GE(off.size(), 8u);
  for (const std::string& name : off) {
    const RenderResult left = picture(without(name, plain()));
    EXPECT_TRUE(std::ranges::equal(all.image.values(), left.image.values())) << name;
    EXPECT_EQ(left.work.of_effect, all.work.of_effect) << name;
    EXPECT_EQ(left.work.camera_rays, all.work.camera_rays) << name;
  }
}

TEST(LeavingOutShadows, MakesNoPixelDarkerWhereLightIsDirect) {
  Scene scene = small(everything());
  scene.depth.glossy = 0;
  scene.sampler.sample_count = 64;
  const Image shadowed = render(scene, {}).image, lit = picture(without("shadows", scene)).image;
  double more = 0, less = 0;
  for (std::size_t i = 0; i < lit.values().size(); ++i) {
    more += std::max(0.f, lit.values()[i] - shadowed.values()[i]);
    less += std::max(0.f, shadowed.values()[i] - lit.values()[i]);
  }
  EXPECT_GT(more, 1);
  EXPECT_LT(less, 1e-3 * more);
}

TEST(LeavingOutShadows, LeavesTheAlbedoBelowAnEvenSkyWhicheverWayItsDirectionsAreDrawn) {
  Scene scene = sphere_on_plane(24);
  scene.lights = {ConstantLight{{1, 1, 1}}};
  const auto least = [](const Image& image) { return *std::ranges::min_element(image.values()); };
  EXPECT_LT(least(render(scene, {}).image), 0.4) << "the sphere's shadow";
  const Image lit = picture(without("shadows", scene)).image;
  for (const float value : lit.values())
    EXPECT_NEAR(value, value < 0.65 ? 0.5 : 0.8, 1e-5) << "floor or ball";
  EXPECT_GT(*std::ranges::max_element(lit.values()), 0.7);
  RenderOptions by_light;
  by_light.experiment = {Experiment::Directions::kLight, false};
  scene.sampler.sample_count = 256;
  EXPECT_NEAR(mean(render(scene, by_light).image) / mean(lit), 1, 0.01);
}

TEST(PointsOfTheSamePower, LightAFarSurfaceAsTheLampsDo) {
  Scene scene = plain();
  scene.materials[0].diffuse_reflectance = {0.5, 0.5, 0.5};
  scene.materials[0].specular_reflectance = {};
  scene.sampler.sample_count = 64;
  for (const Light& lamp :
       {Light(SphereLight{{6, 30, 30}, 0.5, {900, 900, 900}}),
        Light(RectangleLight{{6, 30, 30}, {0.5, 0, 0}, {0, -0.3, 0.3}, {900, 900, 900}})}) {
    scene.lights = {lamp};
    const auto centre = [](const Image& image) { return image.values()[3 * (12 * 24 + 12)]; };
    const float soft = centre(render(scene, {}).image);
    EXPECT_GT(soft, 0.01);
    EXPECT_NEAR(centre(picture(without("area_lights", scene)).image) / soft, 1, 0.02);
  }
}

TEST(TheTableOfEverything, HasARowForEveryEffectThatIsOnWithItsErrorAndTheRaysItSaves) {
  Options options;
  options.effort = Effort::kQuick;
  options.scenes = {{"all", everything()}};
  const Table table = measure_effects(options).at(0);
  std::vector<std::string> names{"everything"};
  for (const std::string& name : effects_that_are(true, make_plan(everything(), kAsCalledFor)))
    names.push_back("without " + name);
  std::vector<std::string> rows;
  for (const Variant& variant : table.variants) {
    rows.push_back(variant.name);
    EXPECT_EQ(variant.errors.size(), table.errors.size());
    EXPECT_GT(cost_of(variant).median, 0);
  }
  EXPECT_EQ(rows, names);
  EXPECT_EQ(table.id, "effects-all");

  for (std::size_t e = 0; e < table.errors.size(); ++e) {
    EXPECT_EQ(table.variants[0].errors[e].second, 0);
    for (std::size_t i = 1; i < table.variants.size(); ++i)
      EXPECT_GT(table.variants[i].errors[e].second, 1e-4) << table.variants[i].name;
  }

  const auto all = [](const Variant& variant) {
    const records::Rays& rays = variant.facts.value().rays.value();
    return double(rays.camera + rays.shadow + rays.mirror + rays.scattered);
  };
  for (const Variant& variant : table.variants)
    EXPECT_EQ(variant.facts->rays_saved, all(table.variants[0]) - all(variant)) << variant.name;
  EXPECT_THAT(table.remarks, testing::Contains(HasSubstr("shadows")));
}

}  // namespace
}  // namespace lobelia::cost
