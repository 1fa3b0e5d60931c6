// The own light transport of engines, against ours and on scenes that they refuse.
#include "studies/cost/convergence.hpp"

#include "studies/cost/scenes.hpp"
#include "tests/reference_scenes/require_engine.hpp"
#include "tests/test.hpp"

namespace lobelia::cost {
namespace {

ReferenceOptions own_transport() {
  ReferenceOptions options;
  options.own_transport = true;
  return options;
}

/// The engines that say that they have one.
std::vector<std::unique_ptr<Engine>> engines_with_transport() {
  std::vector<std::unique_ptr<Engine>> engines;
  for (const EngineInfo& info : engine_infos())
    if (!info.transport.empty()) engines.push_back(make_engine(info.name, {}));
  return engines;
}

TEST(OwnTransport, ShowsTheSameLightAsOurs) {
  constexpr int kSide = 24, kSamples = 256;
  ASSERT_FALSE(engines_with_transport().empty());
  for (const auto& engine : engines_with_transport()) {
    require_engine(*engine);
    if (testing::Test::IsSkipped() || testing::Test::HasFatalFailure()) return;
    Session session(*engine, own_transport());
    for (Scene scene : {below_rectangle(kSide), below_sky(kSide),
                        with_inter_reflection(below_rectangle(kSide))}) {
      scene.sampler.sample_count = kSamples;
      scene.sampler.seed = 1;
      const ReferenceResult theirs = session.render(scene);
      ASSERT_EQ(theirs.error, "");
      const Image ours = render_timed(scene, kSamples, 1).result.image;
      EXPECT_NEAR(mean(theirs.image) / mean(ours), 1, 5e-3);
      EXPECT_LT(rms_of_difference(theirs.image, ours), 0.05 * rms(ours));
      EXPECT_GT(theirs.record.seconds.total, 0);
    }
  }
}

TEST(OwnTransport, IsRefusedForAScenePartThatItDoesNotKnow) {
  Scene shiny = below_rectangle(8), mirror = shiny, lamp = shiny, lens = shiny;
  shiny.materials[0].specular_reflectance = {0.5, 0.5, 0.5};
  mirror.materials[1].mirror_reflectance = {0.5, 0.5, 0.5};
  lamp.lights.push_back(PointLight{{0, 3, 0}, {1, 1, 1}});
  lens.camera.aperture_radius = 0.1;
  for (const EngineInfo& info : engine_infos()) {
    const auto engine = make_engine(info.name, {});
    for (const Scene& scene : {shiny, mirror, lamp, lens})
      EXPECT_NE(engine->why_not(scene, own_transport()), "") << info.name;
    EXPECT_EQ(engine->why_not(below_rectangle(8), own_transport()).empty(), !info.transport.empty())
        << info.name;
  }
}

}  // namespace
}  // namespace lobelia::cost
