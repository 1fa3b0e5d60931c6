// The average of scenes without a lens, lights with a size and several rays a pixel is the scene with them.
#include "reference_scenes/replicates.hpp"

#include "tests/more_samples.hpp"
#include "tests/reference_scenes/ourselves.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// By our own renderer, from pictures of the kind that engines are asked for.
ReferenceResult average(const Scene& scene, int points) {
  ReferenceOptions options;
  options.points = points;
  OurselvesAsAnEngine ourselves;
  ReferenceResult result = Session(ourselves, options).render(scene);
  EXPECT_EQ(result.error, "");
  return result;
}

/// The same from samples of lights and directions, as a user would have it; so many that their noise counts
/// for nothing.
Image converged(Scene scene) {
  scene.sampler.sample_count = 32768 * more_samples();
  return render(scene, {}).image;
}

TEST(Replicates, AverageToThePictureWithinTheirOwnNoise) {
  for (NamedScene& named : soft_scenes({"modified_phong", "cosine", "exact", 8}, 16)) {
    SCOPED_TRACE(named.name);
    // With one ray a pixel there is no antialiasing to average; ours has it as soon as it samples.
    if (named.scene.sampler.sample_count == 1) named.scene.sampler.sample_count = 4;
    const Image truth = converged(named.scene);
    double before = 1e9;
    for (const int base : {256, 4096}) {
      const int points = base * more_samples();
      const ReferenceResult result = average(named.scene, points);
      const ReplicateStatistics s = replicate_statistics(result, truth, points, 1e-4);
      // Neighbours share their points, so a few may fall out together.
      EXPECT_LE(s.beyond, 3u) << "of " << s.random << " at " << points << " points";
      EXPECT_LT(double(s.of_twenty), 0.25 * double(s.random) + 5) << points << " points";
      // All pixels share their points, so this is a single draw, whose luck is known at these points alone.
      if (more_samples() == 1) {
        EXPECT_LT(s.rms, before / 2.5) << points << " points";
      }
      before = s.rms;
    }
  }
}

TEST(Replicates, AreTheSameForTheSameSeedAndOthersForAnother) {
  const Scene scene = soft_scenes({"phong_rdf", "cosine", "exact", 8}, 8).back().scene;
  const auto first_light = [&](std::uint64_t seed) {
    return std::get<PointLight>(replicates(scene, 2, 3, seed)[1][2].scene.lights[0]).position;
  };
  EXPECT_EQ(first_light(1), first_light(1));
  EXPECT_NE(first_light(1), first_light(2));
}

TEST(Replicates, ShowAllLampsInOnePictureWhereOnlyLightsVary) {
  const auto scenes = soft_scenes({"phong_rdf", "cosine", "exact", 8}, 8);
  const auto lamps = replicates(scenes[1].scene, 2, 5, 0);
  ASSERT_EQ(lamps.size(), 2u);
  ASSERT_EQ(lamps[0].size(), 1u);
  EXPECT_EQ(lamps[0][0].scene.lights.size(), 6u) << "five lamps and the sun";
  EXPECT_EQ(replicates(scenes[5].scene, 2, 5, 0)[0].size(), 5u);
  EXPECT_FALSE(needs_replicates(lamps[0][0].scene));
}

TEST(Replicates, ShowTheLightsThemselvesOnlyWhereNothingIsBefore) {
  Scene scene = sphere_scene({"phong_rdf", "cosine", "exact", 8}, {}, 32);
  scene.lights = {SphereLight{{0, 0, -3}, 2.5, {3, 3, 3}}, ConstantLight{{1, 0, 0}}};
  const Image seen = SizedLights(scene).seen_in(scene);
  EXPECT_EQ(seen.pixel(16, 16)[0], 0) << "the ball";
  EXPECT_EQ(seen.pixel(0, 0)[0], 1) << "the sky alone";
  EXPECT_EQ(seen.pixel(1, 16)[0], 4) << "the lamp, and the sky behind it";
}

TEST(Replicates, IgnoreTheSurfaceUnderALight) {
  Scene scene = sphere_scene({"phong_rdf", "cosine", "exact", 8}, {}, 64);
  const Vec3 normal = normalize({0.3, -0.2, 1}), along = normalize(cross(normal, {1, 2, 3}));
  const Vec3 place{0.3, 0.2, -3};
  scene.lights = {RectangleLight{place, 2.0 * along, 2.0 * cross(normal, along), {3, 3, 3}},
                  SphereLight{{0, 0, 0}, 1, {5, 5, 5}}};
  Scene empty = scene;
  empty.spheres.clear();
  const Image alone = SizedLights(empty).seen_in(empty);
  scene.planes = {{place + 0.7 * along, normal, 0, 0, 1}};
  const Image seen = SizedLights(scene).seen_in(scene);
  int bulb = 0, rectangle = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      // The bulb's sphere hides what is behind it.
      const float value = alone.pixel(x, y)[0], expected = value > 3 ? 5 : value;
      EXPECT_EQ(seen.pixel(x, y)[0], expected) << x << ", " << y;
      (expected == 5 ? bulb : rectangle) += expected > 0;
    }
  EXPECT_GT(bulb, 500);
  EXPECT_GT(rectangle, 200);
}

}  // namespace
}  // namespace lobelia
