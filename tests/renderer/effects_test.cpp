// Each effect against itself with everything forced.
#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/pixel_ray.hpp"
#include "renderer/render.hpp"
#include "renderer/render_record.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/renderer/blocks.hpp"
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

TEST(TheRaysOfARecord, AreOfTheMirrorWhereOneReflectsAndNothingScatters) {
  Scene scene = on_the_ground();
  scene.materials[0].mirror_reflectance = {0.5, 0.5, 0.5};
  scene.depth.mirror = 1;
  const records::Rays rays = rays_record(render(scene, {}).work);
  EXPECT_GT(rays.mirror, 0u);
  EXPECT_EQ(rays.scattered, 0u);
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
    Blocks planned, all;
    for (int seed = 0; seed < 8; ++seed) {
      Scene scene = s.scene;
      scene.sampler.seed = std::uint64_t(100 + seed);
      planned.add(render(scene, {}).image);
      scene.sampler.seed += 1000;  // independent of the planned one
      all.add(with_all(scene).image);
    }
    double worst = 0, chi_squared = 0;
    for (std::size_t b = 0; b < planned.mean.size(); ++b) {
      const double t = apart(planned, all, b);
      worst = std::max(worst, t);
      chi_squared += t * t;
    }
    EXPECT_GT(*std::max_element(planned.mean.begin(), planned.mean.end()), 0.5) << s.name;
    // Student's t of 14 degrees of freedom: beyond 7 once in 1e5 over all blocks and scenes; its square
    // has a mean of 14/12 and, over 108 blocks, strays from it by more than 1 once in 1e4.
    EXPECT_LT(worst, 7) << s.name;
    EXPECT_LT(chi_squared / double(planned.mean.size()), 2.2) << s.name;
    ++checked;
  }
  EXPECT_GE(checked, 7);
}

}  // namespace
}  // namespace lobelia
