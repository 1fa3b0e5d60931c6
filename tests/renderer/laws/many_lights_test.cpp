// One of many lights is drawn at a time. That changes the noise, and nothing else.
#include "renderer/light_tree.hpp"
#include "renderer/scene/contact.hpp"
#include "tests/more_samples.hpp"
#include "tests/renderer/blocks.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

Vec3 unit(Random& random) {
  for (;;)
    if (const Vec3 v = random.vector(); length(v) > 0.1) return normalize(v);
}
Rgb grey(double value) { return {value, value, value}; }

/// A light above the ground, some thousand times as strong as another.
Light lamp(Random& random, double half) {
  const double strength = std::pow(10, random.between(-2, 1));
  Vec3 at = half * random.vector();
  at.y = 0.5 + std::abs(at.y);
  switch (int(random.between(0, 3))) {
    case 0:
      return DirectionalLight{normalize(unit(random) - Vec3{0, 1, 0}), grey(0.1 * strength)};
    case 1:
      return PointLight{at, grey(strength), unit(random)};
    default:
      return PointLight{at, grey(strength)};
  }
}
Light area_light(Random& random, double half) {
  const double radiance = std::pow(10, random.between(-1, 1.5)), size = random.between(0.02, 0.3);
  Vec3 at = half * random.vector();
  at.y = 0.5 + std::abs(at.y);
  if (random.between(0, 1) < 0.5) return SphereLight{at, size, grey(radiance)};
  const Vec3 normal = unit(random), u = normalize(cross(normal, unit(random)));
  return RectangleLight{at, size * u, 2 * size * cross(normal, u), grey(radiance)};
}
std::vector<Light> many(Random& random, bool area, std::size_t count) {
  std::vector<Light> lights;
  while (lights.size() < count) lights.push_back(area ? area_light(random, 4) : lamp(random, 4));
  return lights;
}
LightTree tree_of(const std::vector<Light>& lights) {
  std::vector<int> all(lights.size());
  std::iota(all.begin(), all.end(), 0);
  return {lights, all, 1e-12};
}

/// The irradiance of the light as a point, on a surface that faces as given.
double irradiance(const Light& light, Vec3 point, Vec3 normal) {
  const auto whole = lamp_of_same_power(light);
  const Illumination light_there = illuminate(whole ? *whole : lamp_of(light), point);
  return light_there.irradiance.r * std::max(0.0, dot(normal, light_there.to_light));
}

TEST(LightTree, DrawsEveryLightWithItsStatedProbability) {
  Random random(2);
  for (int set = 0; set < 40; ++set) {
    const auto lights = many(random, set % 2 == 0, 70);
    const LightTree tree = tree_of(lights);
    const Vec3 point = 3 * random.vector(), normal = unit(random);
    // Evenly spaced numbers fall into each light's share to within one of them for each of its edges.
    constexpr int kDraws = 20000;
    std::vector<int> counts(lights.size());
    int none = 0;
    for (int i = 0; i < kDraws; ++i) {
      const auto drawn = tree.choose(point, normal, (i + 0.5) / kDraws);
      if (drawn.light < 0) {
        ++none;
        continue;
      }
      ++counts[std::size_t(drawn.light)];
      ASSERT_NEAR(tree.probability(drawn.light, point, normal) / drawn.probability, 1, 1e-12);
    }
    double sum = 0;
    for (int l = 0; l < 70; ++l) {
      const double p = tree.probability(l, point, normal);
      sum += p;
      ASSERT_NEAR(counts[std::size_t(l)], kDraws * p, 2) << l;
      ASSERT_TRUE(p > 0 || !(irradiance(lights[std::size_t(l)], point, normal) > 0)) << l;
    }
    // A box may reach above the horizon where none of its lights does: then nothing is drawn.
    ASSERT_NEAR(none, kDraws * (1 - sum), 70);
  }
}

TEST(LightTree, TakesExtremeAndIdenticalAndBlackLights) {
  const std::vector<Light> lights = {
      PointLight{{1e9, 1e9, -1e9}, grey(1e9)},
      PointLight{{0, 1, 0}, grey(1e-30)},
      PointLight{{0, 1, 0}, grey(1e-30)},
      PointLight{{0, 1, 0}, grey(0)},
      SphereLight{{0, 2, 0}, 1e-9, grey(1e9)},
      SphereLight{{0, 2, 0}, 1e9, grey(1e-300)},
      DirectionalLight{{0, -1, 0}, grey(1e9)},
      RectangleLight{{0, 3, 0}, {1e9, 0, 0}, {0, 0, 1e9}, grey(1e9)}};
  std::vector<int> lamps = {0, 1, 2, 3, 6}, area = {4, 5, 7};
  for (const auto& indices : {lamps, area}) {
    const LightTree tree(lights, indices, 1e-3);
    for (const Vec3 point :
         {Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{1e9, 1e9, -1e9}, Vec3{0, 1 - 1e-16, 0}})
      for (const Vec3 normal : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{1, 0, 0}})
        for (const double u : {0.0, 0.25, 0.5, 1 - 0x1p-32}) {
          const auto drawn = tree.choose(point, normal, u);
          ASSERT_NE(drawn.light, 3) << "it is black";
          if (drawn.light < 0) continue;
          ASSERT_GT(drawn.probability, 0);
          ASSERT_LE(drawn.probability, 1);
        }
  }
  EXPECT_EQ(LightTree(lights, std::vector<int>{3}, 1).choose({}, {0, 1, 0}, 0.5).light, -1);
  EXPECT_EQ(LightTree(lights, std::vector<int>{}, 1).choose({}, {0, 1, 0}, 0.5).light, -1);
}

/// The variance of irradiance / probability, for irradiances that are known.
TEST(LightTree, HasFarLessVarianceThanAnEvenChoice) {
  Random random(3);
  std::vector<double> ratios;
  for (int set = 0; set < 100; ++set) {
    const auto lights = many(random, set % 2 == 0, std::size_t(random.between(65, 1000)));
    const LightTree tree = tree_of(lights);
    const Vec3 point{random.between(-3, 3), 0, random.between(-3, 3)}, up{0, 1, 0};
    double sum = 0, by_tree = 0, evenly = 0;
    for (int l = 0; l < int(lights.size()); ++l) {
      const double e = irradiance(lights[std::size_t(l)], point, up);
      if (!(e > 0)) continue;
      sum += e;
      by_tree += e * e / tree.probability(l, point, up);
      evenly += e * e * double(lights.size());
    }
    ratios.push_back((by_tree - sum * sum) / (evenly - sum * sum));
  }
  std::ranges::sort(ratios);
  EXPECT_LT(ratios[50], 0.2) << "0.12 was measured";
  EXPECT_LT(ratios.back(), 1);
}

/// Spheres, mirrors and a ground under many lights, some of which lie on a surface.
Scene under_many_lights(Random& random, bool area) {
  Scene scene = on_the_ground();
  scene.film = {16, 12};
  scene.sampler.sample_count = 16 * more_samples();
  scene.materials[0] = shiny(random.between(2, 64));
  if (random.between(0, 1) < 0.3) scene.materials[0].mirror_reflectance = grey(0.5);
  scene.depth = {2, int(random.between(area ? 0 : 1, 3))};
  scene.lights = many(random, area, std::size_t(std::pow(10, random.between(1.82, 3))));
  if (area) {
    scene.lights[0] = RectangleLight{{0, 0, 1}, {0.2, 0, 0}, {0, 0, -0.2}, grey(2)};
    scene.lights[1] = SphereLight{{1.2, 0.7, 0.5}, 0.7, grey(0.5)};
  } else {
    scene.lights[0] = PointLight{{0.3, 0, 1}, grey(0.5)};
  }
  if (random.between(0, 1) < 0.3)  // for Embree
    for (int k = 0; k < 30; ++k) {
      const double radius = random.between(0.05, 0.3);
      scene.spheres.push_back(
          {{random.between(-3, 3), radius, random.between(-3, 2)}, radius, int(k % 2)});
    }
  if (random.between(0, 1) < 0.3) scene.lights.push_back(ConstantLight{grey(0.3)});
  return scene;
}

class ManyLights : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Kinds, ManyLights, testing::Bool(), [](const auto& info) {
  return info.param ? "WithASize" : "WithoutASize";
});

TEST_P(ManyLights, AreAsBrightAsTheSumOverEachWithinTheNoise) {
  Random random(GetParam() ? 4 : 5);
  for (int k = 0; k < (more_samples() == 1 ? 1 : 4); ++k) {
    const Scene scene = under_many_lights(random, GetParam());
    RenderOptions summed;
    summed.experiment.sum_all_lights = true;
    SCOPED_TRACE(k);
    ASSERT_NO_FATAL_FAILURE(expect_the_same_light(
        scene, {}, summed, {{16, 4.5}, {64, 5.0}, {512, 5.5}, {2048, 6.0}}, 64));
    const RenderResult one = render(scene, {});
    ASSERT_TRUE(GetParam() ? one.plan.draws_area_light : one.plan.draws_lamp);
  }
}

TEST_P(ManyLights, AreTheSameWithEveryEffectForcedWithinTheNoise) {
  Random random(GetParam() ? 6 : 7);
  for (int k = 0; k < (more_samples() == 1 ? 1 : 2); ++k) {
    SCOPED_TRACE(k);
    RenderOptions forced;
    forced.effects = EffectPolicy::kAll;
    ASSERT_NO_FATAL_FAILURE(expect_the_same_light(under_many_lights(random, GetParam()), {}, forced,
                                                  {{32, 5.0}, {256, 5.5}}));
  }
}

TEST(ManyLightsWithoutASize, AreSummedExactlyAtTheFirstSurfaceAndInMirrors) {
  Random random(8);
  for (int k = 0; k < 8; ++k) {
    Scene scene = under_many_lights(random, false);
    std::erase_if(scene.lights, is_environment);
    scene.sampler.sample_count = 1;
    scene.depth.glossy = 0;
    RenderOptions options, summed;
    summed.experiment.sum_all_lights = true;
    const Image picture = render(scene, options).image;
    EXPECT_TRUE(same(picture, render(scene, summed).image));
    scene.sampler.seed = 99;
    EXPECT_TRUE(same(picture, render(scene, options).image));
    // 64 lights at a time, each with occluders of its own.
    Image parts(picture.width(), picture.height());
    for (std::size_t first = 0; first < scene.lights.size(); first += 64) {
      Scene part = scene;
      part.lights.assign(
          scene.lights.begin() + std::ptrdiff_t(first),
          scene.lights.begin() + std::ptrdiff_t(std::min(first + 64, scene.lights.size())));
      const Image one = render(part, options).image;
      for (std::size_t i = 0; i < one.values().size(); ++i) parts.values()[i] += one.values()[i];
    }
    for (std::size_t i = 0; i < parts.values().size(); ++i)
      ASSERT_NEAR(picture.values()[i], parts.values()[i], 1e-4 * (1e-3 + parts.values()[i])) << i;
  }
}

TEST_P(ManyLights, MayBe65536) {
  Random random(9);
  Scene scene = on_the_ground();
  scene.film = {4, 3};
  scene.depth.glossy = 1;
  scene.lights = many(random, GetParam(), 65536);
  for (int k = 0; k < 300; ++k) scene.spheres.push_back({{0.1 * k, -5, 0}, 0.05, 1});
  EXPECT_LE(remarks(scene).size(), 16u);
  const Image image = render(scene, {}).image;
  for (const float v : image.values()) ASSERT_TRUE(std::isfinite(v) && v >= 0);
  EXPECT_GT(mean(image), 0);
}

// Skies at random: what the sky draws and what surfaces draw is together its light.

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
