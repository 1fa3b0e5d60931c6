// Skies at random: what the sky draws and what surfaces draw is together its light.
#include "tests/more_samples.hpp"
#include "tests/renderer/blocks.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// A haze with some spots, which may be as small as a pixel, as bright as a sun, or as wide as half of the sky.
std::shared_ptr<const Image> random_sky(Random& random) {
  struct Spot {
    Vec3 to;
    double cosine;
    Rgb radiance;
  };
  std::vector<Spot> spots;
  for (int k = random.below(4); k >= 0; --k) {
    const double size = random.log_between(0.02, 1.5);
    const double light = random.log_between(0.1, 3) / (size * size);
    spots.push_back({random.direction(), std::cos(size),
                     light * Rgb{random.even(), random.even(), random.even()}});
  }
  const double haze = random.chance(0.3) ? 0 : random.log_between(0.01, 1);
  auto image = std::make_shared<Image>(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) {
      const double down = kPi * (y + 0.5) / 32, turn = 2 * kPi * ((x + 0.5) / 64 - 0.5);
      const Vec3 to{std::sin(down) * std::sin(turn), std::cos(down),
                    -std::sin(down) * std::cos(turn)};
      Rgb sum{haze, haze, haze};
      for (const Spot& spot : spots)
        if (dot(to, spot.to) >= spot.cosine) sum = sum + spot.radiance;
      auto pixel = image->pixel(x, y);
      pixel[0] = float(sum.r), pixel[1] = float(sum.g), pixel[2] = float(sum.b);
    }
  return image;
}

Scene below_random_sky(Random& random) {
  Scene scene = on_the_ground();
  scene.film = {16, 12};
  scene.sampler.sample_count = 32 * more_samples();
  if (random.chance(0.5)) scene.materials[0] = shiny(random.log_between(1, 200));
  if (random.chance(0.3)) scene.materials[1].mirror_reflectance = {0.5, 0.5, 0.5};
  scene.depth = {1, random.below(3)};
  scene.lights = {EnvmapLight{{1, 1, 1}, random_sky(random), ""}};
  if (random.chance(0.2)) scene.lights.push_back(ConstantLight{{0.2, 0.2, 0.2}});
  return scene;
}

TEST(RandomSkies, BringTheSameLightAsRaysThatAreDrawnEvenly) {
  Random random(11);
  RenderOptions even;
  even.experiment.directions = Experiment::Directions::kEven;
  for (int k = 0; k < 3; ++k) {
    SCOPED_TRACE(k);
    ASSERT_NO_FATAL_FAILURE(expect_the_same_light(below_random_sky(random), {}, even));
  }
}

TEST(RandomSkies, GiveTheSameLightWithEveryEffectForced) {
  Random random(12);
  RenderOptions by_light, forced;
  by_light.experiment.directions = Experiment::Directions::kLight;
  forced.effects = EffectPolicy::kAll;
  for (int k = 0; k < 3; ++k) {
    SCOPED_TRACE(k);
    Scene scene = below_random_sky(random);
    ASSERT_NO_FATAL_FAILURE(expect_the_same_light(scene, {}, forced));
    scene.depth = {0, 0};
    ASSERT_NO_FATAL_FAILURE(expect_the_same_light(scene, {}, by_light));
  }
}

TEST(AnEvenSky, NeedsNoShadowRays) {
  Scene scene = on_the_ground();
  scene.lights = {EnvmapLight{{1, 1, 1}, sky([](int, int) { return 0.5f; }), ""}};
  EXPECT_EQ(render(scene, {}).work.shadow_rays, 0u);
}

}  // namespace
}  // namespace lobelia
