// The average of scenes without a lens, lights with a size and several rays a pixel is the scene with them.
#include "reference_scenes/replicates.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

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

double rms(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    sum += std::pow(double(a.values()[i]) - double(b.values()[i]), 2);
  return std::sqrt(sum / double(a.values().size()));
}

TEST(Replicates, AverageToThePictureWithinTheirOwnNoiseAndComeNearerWithMorePoints) {
  for (NamedScene& named : soft_scenes({"modified_phong", "cosine", "exact", 8}, 16)) {
    SCOPED_TRACE(named.name);
    // With one ray a pixel there is no antialiasing to average; ours has it as soon as it samples.
    if (named.scene.sampler.sample_count == 1) named.scene.sampler.sample_count = 4;
    const Image truth = converged(named.scene);
    const double peak = *std::ranges::max_element(truth.values());
    double before = 1e9;
    for (const int points : {256, 4096}) {
      const ReferenceResult result = average(named.scene, points);
      // Independent estimates of each pixel, whose differences from the truth have a t-distribution.
      const boost::math::students_t t(kReplicates - 1);
      const double pixels = double(truth.pixel_count());
      const double limit = boost::math::quantile(
          boost::math::complement(t, (1 - std::pow(1 - 1e-3, 1 / (3 * pixels))) / 2));
      std::size_t beyond = 0, of_twenty = 0, random = 0;
      for (std::size_t i = 0; i < truth.values().size(); ++i) {
        // An edge that one point in a thousand sees may be seen by none, which would be no error.
        const double error = std::max(double(result.standard_error.values()[i]), peak / points / 4);
        const double apart = double(result.image.values()[i]) - double(truth.values()[i]);
        // Where nothing varies there is rounding alone.
        const double rounding = 1e-4 * double(truth.values()[i]) + 1e-6;
        if (std::abs(apart) <= rounding) continue;
        ++random;
        if (std::abs(apart) - rounding > limit * error) ++beyond;
        if (std::abs(apart) > boost::math::quantile(t, 0.975) * error) ++of_twenty;
      }
      // Neighbours share their points, so a few may fall out together.
      EXPECT_LE(beyond, 3u) << "of " << random << " at " << points << " points";
      EXPECT_LT(double(of_twenty), 0.25 * double(random) + 5) << points << " points";
      const double apart = rms(result.image, truth);
      EXPECT_LT(apart, before / 2.5) << points << " points";
      before = apart;
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
