// The average of scenes without a lens, lights with a size and several rays a pixel is the scene with them.
#include "reference_scenes/replicates.hpp"

#include <gtest/gtest.h>

#include "reference_scenes/replicate_statistics.hpp"
#include "tests/reference_scenes/ourselves.hpp"
#include "tests/reference_scenes/test_scenes.hpp"

namespace lobelia {
namespace {

/// By our own renderer, from pictures of the kind that engines are asked for.
ReferenceResult average(const Scene& scene, int points) {
  ReferenceOptions options;
  options.points = points;
  ReferenceResult result;
  OurselvesAsAnEngine().render(
      std::span(&scene, 1), options,
      [&](std::size_t, ReferenceResult done) { result = std::move(done); });
  EXPECT_EQ(result.error, "");
  return result;
}

/// The same from samples of lights and directions, as a user would have it; so many that their noise counts
/// for nothing.
Image converged(Scene scene) {
  scene.sampler.sample_count = 32768;
  return render(scene, {}).image;
}

TEST(Replicates, AverageToThePictureWithinTheirOwnNoiseAndComeNearerWithMorePoints) {
  for (NamedScene& named : soft_scenes({"modified_phong", "cosine", "exact", 8}, 16)) {
    SCOPED_TRACE(named.name);
    // With one ray a pixel there is no antialiasing to average; ours has it as soon as it samples.
    if (named.scene.sampler.sample_count == 1) named.scene.sampler.sample_count = 4;
    const Image truth = converged(named.scene);
    double before = 1e9;
    for (const int points : {256, 4096}) {
      const ReferenceResult result = average(named.scene, points);
      const ReplicateStatistics s = replicate_statistics(result, truth, points, 1e-4);
      // Neighbours share their points, so a few may fall out together.
      EXPECT_LE(s.beyond, 3u) << "of " << s.random << " at " << points << " points";
      EXPECT_LT(double(s.of_twenty), 0.25 * double(s.random) + 5) << points << " points";
      EXPECT_LT(s.rms, before / 2.5) << points << " points";
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

TEST(Replicates, WhereOnlyLightsVaryAreOnePictureEachWithAllLamps) {
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
  scene.lights = {SphereLight{{0, 0, -3}, 2.5, {3, 3, 3}}, EnvironmentLight{{1, 0, 0}, {}, {}}};
  const Image seen = SizedLights(scene).seen_in(scene);
  EXPECT_EQ(seen.pixel(16, 16)[0], 0) << "the ball";
  EXPECT_EQ(seen.pixel(0, 0)[0], 1) << "the sky alone";
  EXPECT_EQ(seen.pixel(1, 16)[0], 4) << "the lamp, and the sky behind it";
}

}  // namespace
}  // namespace lobelia
