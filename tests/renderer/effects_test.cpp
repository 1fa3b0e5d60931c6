// Each effect against itself with everything forced.
#include "renderer/pixel_ray.hpp"
#include "renderer/render.hpp"
#include "renderer/render_record.hpp"
#include "tests/canonical_scene.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(Effects, ForcedGiveTheSamePictureBitForBitWhereNothingIsRandom) {
  Scene ground = on_the_ground(), mirrors = ground;
  mirrors.materials[0].mirror_reflectance = {0.5, 0.6, 0.7};
  mirrors.materials[0].fresnel = Fresnel::kSchlick;
  mirrors.depth.mirror = 4;
  Scene crowd = canonical_scene("head_on");
  crowd.film = {40, 40};
  crowd.materials[0].mirror_reflectance = {0.3, 0.3, 0.3};
  crowd.depth.mirror = 2;
  crowd.spheres.clear();
  for (int i = 0; i < 1200; ++i)
    crowd.spheres.push_back(
        {{(i % 12 - 5.5) * 0.1, (i / 12 % 10 - 4.5) * 0.1, i / 120 * -0.1}, 0.04});
  for (const Scene& scene : {ground, mirrors, crowd}) {
    const RenderResult planned = render(scene, {}), all = with_all(scene);
    EXPECT_TRUE(same(planned.image, all.image)) << scene.spheres.size();
    EXPECT_GT(all.work.scattered_rays, planned.work.scattered_rays) << scene.spheres.size();
    EXPECT_GT(mean(planned.image), 1e-4) << scene.spheres.size();
  }
}

TEST(TheRaysOfARecord, CountMirrorRaysApart) {
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

}  // namespace
}  // namespace lobelia
