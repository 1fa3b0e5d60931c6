// Renders that stop: at an error, at a time, at a number of samples.
#include "tests/renderer/simple_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

Scene noisy() {
  Scene scene;
  scene.camera = {{0, 2, 6}, {0, 0.8, 0}, {0, 1, 0}, 40};
  scene.film = {64, 48};
  scene.sampler.sample_count = 16;
  scene.lights = {SphereLight{{2, 4, 2}, 0.7, {20, 20, 20}}};
  scene.materials = {matt(0.5)};
  scene.spheres = {{{0, 1, 0}, 1, 0}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}}};
  return scene;
}

double rms_difference(const Image& a, const Image& b) {
  double difference = 0, value = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    difference += std::pow(double(a.values()[i]) - b.values()[i], 2);
    value += std::pow(double(b.values()[i]), 2);
  }
  return std::sqrt(difference / value);
}

TEST(Rounds, StopAtTheRequestedError) {
  Scene scene = noisy();
  scene.sampler.sample_count = 4096;
  const Image truth = render(scene, {}).image;
  scene.sampler.seed = 5;
  int last = 0;
  for (const double target : {0.1, 0.03, 0.01}) {
    RenderOptions options;
    options.target_error = target;
    const RenderResult result = render(scene, options);
    EXPECT_LE(*result.error, target);
    EXPECT_LE(rms_difference(result.image, truth), 1.1 * target) << target;
    EXPECT_GE(result.samples, last);
    EXPECT_NE(result.stop_reason.find("error"), std::string::npos) << result.stop_reason;
    last = result.samples;
  }
  EXPECT_GT(last, 8);
}

TEST(Rounds, TakeNoMoreSamplesThanAllowed) {
  RenderOptions options;
  options.target_error = 1e-9;
  options.max_samples = 24;
  const RenderResult result = render(noisy(), options);
  EXPECT_EQ(result.samples, 24);
  EXPECT_EQ(result.work.camera_rays, 64u * 48 * 24);
  EXPECT_GT(*result.error, 1e-9);
}

TEST(Rounds, GiveThePictureOfTheSameSamplesTakenAtOnce) {
  Scene scene = noisy();
  RenderOptions options;
  options.target_error = 1e-9;
  options.max_samples = 16;
  const Image rounds = render(scene, options).image, at_once = render(scene, {}).image;
  for (std::size_t i = 0; i < rounds.values().size(); ++i)
    EXPECT_NEAR(rounds.values()[i], at_once.values()[i], 1e-6 * (1 + at_once.values()[i]));
}

TEST(Rounds, StopWhenTheTimeIsUp) {
  Scene scene = noisy();
  scene.sampler.sample_count = 65536;
  RenderOptions options;
  options.time_limit = 0.2;
  const RenderResult result = render(scene, options);
  EXPECT_GE(result.samples, 1);
  EXPECT_LT(result.samples, 65536);
  EXPECT_NE(result.stop_reason.find("time limit"), std::string::npos) << result.stop_reason;
}

TEST(Rounds, AreOneForAPictureWithNothingRandom) {
  Scene scene = noisy();
  scene.sampler.sample_count = 1;
  scene.lights = {DirectionalLight{normalize({-1, -2, -1}), {1, 1, 1}}};
  RenderOptions options;
  options.target_error = 1e-6;
  const RenderResult result = render(scene, options);
  EXPECT_EQ(result.samples, 1);
  EXPECT_FALSE(result.error);
}

}  // namespace
}  // namespace lobelia
