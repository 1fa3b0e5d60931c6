// Each effect against what is known of it, and against itself with everything forced.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "renderer/pixel_ray.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/renderer/simple_scenes.hpp"

namespace lobelia {
namespace {

/// One of each kind, for laws that hold of every scene.
struct Named {
  std::string name;
  Scene scene;
  bool random;
};

std::vector<Named> scenes() {
  std::vector<Named> all;
  for (const char* name : {"head_on", "oblique_45", "point_light", "two_lights", "two_spheres"}) {
    Scene scene = canonical_scene(name);
    scene.film = {61, 43};
    all.push_back({name, scene, false});
  }
  const Scene ground = on_the_ground();
  all.push_back({"ground", ground, false});
  Scene scene = ground;
  scene.materials[0].mirror_reflectance = {0.5, 0.6, 0.7};
  scene.depth.mirror = 4;
  all.push_back({"mirrors", scene, false});
  scene.materials[0].fresnel = Fresnel::kSchlick;
  all.push_back({"mirrors with fresnel", scene, false});
  Scene crowd = canonical_scene("head_on");
  crowd.film = {40, 40};
  crowd.materials[0].mirror_reflectance = {0.3, 0.3, 0.3};
  crowd.depth.mirror = 2;
  crowd.spheres.clear();
  for (int i = 0; i < 1200; ++i)
    crowd.spheres.push_back(
        {{(i % 12 - 5.5) * 0.1, (i / 12 % 10 - 4.5) * 0.1, i / 120 * -0.1}, 0.04});
  all.push_back({"crowd", crowd, false});
  crowd.spheres.resize(200);
  all.push_back({"small crowd", crowd, false});

  scene = ground;
  scene.sampler = {16, 3};
  all.push_back({"antialiased", scene, true});
  scene = ground;
  scene.sampler = {64, 3};
  scene.lights = {SphereLight{{2, 4, 2}, 0.7, {20, 20, 20}}};
  all.push_back({"sphere light", scene, true});
  scene.lights = {RectangleLight{{0, 4, 2}, {1, 0, 0}, {0, 0, 1}, {5, 5, 5}}};
  all.push_back({"rectangle light", scene, true});
  scene.lights = {ConstantLight{{0.5, 0.6, 0.7}}};
  all.push_back({"environment", scene, true});
  scene.lights = {EnvmapLight{
      {1, 1, 1},
      sky([](int x, int y) { return x > 40 && x < 44 && y > 8 && y < 11 ? 50.f : 0.1f; }),
      ""}};
  all.push_back({"environment image", scene, true});
  scene.lights = ground.lights;
  scene.depth.glossy = 2;
  all.push_back({"glossy", scene, true});
  scene.depth.glossy = 0;
  scene.camera.aperture_radius = 0.1;
  scene.camera.focus_distance = 6;
  all.push_back({"depth of field", scene, true});
  return all;
}

// ---- laws of the plan

TEST(Effects, WhatIsOffDidNothing) {
  int off = 0;
  for (const Named& s : scenes()) {
    RenderResult result = render(s.scene, {});
    ASSERT_EQ(result.plan.effects.size(), Effects::kSize);
    for (std::size_t i = 0; i < Effects::kSize; ++i) {
      if (result.plan.effects[i].on) continue;
      ++off;
      EXPECT_EQ(result.work.of_effect[i], 0u) << s.name << ": " << result.plan.effects[i].name;
    }
    EXPECT_EQ(result.work.shadow_rays, result.work.of<effects::Shadows>()) << s.name;
    EXPECT_EQ(result.work.mirror_rays, result.work.of<effects::Mirror>()) << s.name;
  }
  EXPECT_GT(off, 50);
}

TEST(Effects, EachIsOnSomewhereAndDoesSomethingThere) {
  std::array<bool, Effects::kSize> worked{}, was_off{};
  for (const Named& s : scenes()) {
    const RenderResult result = render(s.scene, {});
    for (std::size_t i = 0; i < Effects::kSize; ++i) {
      worked[i] |= result.work.of_effect[i] > 0;
      was_off[i] |= !result.plan.effects[i].on;
    }
  }
  const Plan plan = make_plan(scenes()[0].scene, EffectPolicy::kAsCalledFor);
  for (std::size_t i = 0; i < Effects::kSize; ++i) {
    EXPECT_TRUE(worked[i]) << plan.effects[i].name;
    EXPECT_TRUE(was_off[i]) << plan.effects[i].name;
  }
}

TEST(Effects, NoMoreRaysAreTracedThanThePlanExpects) {
  for (const Named& s : scenes())
    for (const EffectPolicy policy : {EffectPolicy::kAsCalledFor, EffectPolicy::kAll}) {
      RenderOptions options;
      options.effects = policy;
      const RenderResult r = render(s.scene, options);
      EXPECT_LE(r.work.camera_rays, r.plan.camera_rays) << s.name;
      EXPECT_LE(r.work.shadow_rays, r.plan.max_shadow_rays) << s.name;
      EXPECT_LE(r.work.mirror_rays, r.plan.max_mirror_rays) << s.name;
      EXPECT_LE(r.work.scattered_rays, r.plan.max_scattered_rays) << s.name;
    }
}

TEST(Effects, ForcedGiveTheSamePictureBitForBitWhereNothingIsRandom) {
  int checked = 0;
  for (const Named& s : scenes()) {
    if (s.random) continue;
    const RenderResult planned = render(s.scene, {}), all = with_all(s.scene);
    EXPECT_TRUE(same(planned.image, all.image)) << s.name;
    EXPECT_GT(all.work.scattered_rays, planned.work.scattered_rays) << s.name;
    EXPECT_GT(mean(planned.image), 1e-4) << s.name;
    ++checked;
  }
  EXPECT_GE(checked, 10);
}

TEST(TheInsideOfASphere, IsDarkWhicheverWayALightIsLookedFor) {
  // A camera in the sphere does not see it, but sees the half of another that it holds.
  for (const bool mirror : {false, true}) {
    Material material = shiny(16);
    if (mirror) material.mirror_reflectance = {0.5, 0.5, 0.5};
    Scene scene = one_sphere(material);
    scene.spheres.push_back({scene.camera.origin, 4.5, 0});
    scene.depth.mirror = 2;
    scene.sampler.sample_count = 4;
    scene.lights = {ConstantLight{{1, 1, 1}}, DirectionalLight{{0, 0, -1}, {1, 1, 1}},
                    SphereLight{{0, 3, 3}, 0.5, {1, 1, 1}}};
    for (const EffectPolicy policy : {EffectPolicy::kAsCalledFor, EffectPolicy::kAll}) {
      RenderOptions options;
      options.effects = policy;
      const Image image = render(scene, options).image;
      for (const float v : image.values()) ASSERT_EQ(v, 0);
    }
    EXPECT_FALSE(light_at(scene, 1, {0, {0, 0, 1}, {0, 0, 1}}));
    scene.spheres.pop_back();
    EXPECT_TRUE(light_at(scene, 1, {0, {0, 0, 1}, {0, 0, 1}}));
    EXPECT_GT(mean(render(scene, {}).image), 0.1);
  }
}

TEST(Effects, ForcedGiveTheSamePictureWithinTheNoiseWhereSomethingIs) {
  int checked = 0;
  for (const Named& s : scenes()) {
    if (!s.random) continue;
    // Means over blocks of four pixels in eight pictures each: their difference by its own spread.
    constexpr int kSeeds = 8;
    std::vector<std::vector<double>> of[2];
    for (int seed = 0; seed < kSeeds; ++seed) {
      Scene scene = s.scene;
      scene.sampler.seed = std::uint64_t(100 + seed);
      for (int policy = 0; policy < 2; ++policy) {
        if (policy == 1) scene.sampler.seed += 1000;  // independent of the planned one
        const Image image = policy == 0 ? render(scene, {}).image : with_all(scene).image;
        std::vector<double> blocks(12 * 9);
        for (int y = 0; y < 36; ++y)
          for (int x = 0; x < 48; ++x)
            blocks[std::size_t(y / 4 * 12 + x / 4)] += image.pixel(x, y)[1] / 16.0;
        of[policy].push_back(blocks);
      }
    }
    double worst = 0, bright = 0, chi_squared = 0;
    int blocks = 0;
    for (std::size_t b = 0; b < 12 * 9; ++b) {
      double m[2]{}, v[2]{};
      for (int p = 0; p < 2; ++p) {
        for (const auto& image : of[p]) m[p] += image[b] / kSeeds;
        for (const auto& image : of[p]) v[p] += std::pow(image[b] - m[p], 2) / (kSeeds - 1);
      }
      bright = std::max(bright, m[0]);
      // Below float32's own roundings nothing is noise.
      const double spread = std::sqrt((v[0] + v[1]) / kSeeds) + 1e-6 * (m[0] + m[1]) + 1e-9;
      const double t = std::abs(m[0] - m[1]) / spread;
      worst = std::max(worst, t);
      chi_squared += t * t;
      ++blocks;
    }
    EXPECT_GT(bright, 0.01) << s.name;
    // Student's t of 14 degrees of freedom: beyond 7 once in 1e5 over all blocks and scenes; its square
    // has a mean of 14/12 and, over 108 blocks, strays from it by more than 1 once in 1e4.
    EXPECT_LT(worst, 7) << s.name;
    EXPECT_LT(chi_squared / blocks, 2.2) << s.name;
    ++checked;
  }
  EXPECT_GE(checked, 7);
}

TEST(Effects, AreTheSameBitForBitWhateverTheNumberOfThreads) {
  for (const Named& s : scenes()) {
    RenderOptions one, many;
    one.threads = 1;
    many.threads = 5;
    EXPECT_TRUE(same(render(s.scene, one).image, render(s.scene, many).image)) << s.name;
  }
}

TEST(Effects, AreTheSameBitForBitInRowsAsInOnePiece) {
  for (const Named& s : scenes()) {
    Image rows(s.scene.film.width, s.scene.film.height);
    int next = 0;
    render(s.scene, {}, [&](int y, int count, const float* rgb) {
      EXPECT_EQ(y, next);
      next = y + count;
      std::copy_n(rgb, 3 * count * rows.width(), rows.values().data() + 3 * y * rows.width());
    });
    EXPECT_EQ(next, rows.height());
    EXPECT_TRUE(same(rows, render(s.scene, {}).image)) << s.name;
  }
}

// ---- lights with a size

}  // namespace
}  // namespace lobelia
