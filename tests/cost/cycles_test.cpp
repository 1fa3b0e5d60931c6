// Cycles on the scenes of light transport.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "cost/transport/cycles.hpp"
#include "cost/transport/measure.hpp"
#include "cost/transport/scenes.hpp"
#include "tests/reference_scenes/require_engine.hpp"

namespace lobelia::cost {
namespace {

TEST(CyclesOnOurTransportScenes, ShowsTheSameLight) {
  const auto engine = make_engine("blender", {});
  require_engine(*engine);
  if (testing::Test::IsSkipped() || testing::Test::HasFatalFailure()) return;
  constexpr int kSide = 24, kSamples = 256;
  const TemporaryDirectory directory;
  for (const Scene& scene : {below_rectangle(kSide), below_sky(kSide, directory.path()),
                             with_inter_reflection(below_rectangle(kSide))}) {
    std::vector<CyclesPicture> pictures{{kSide, kSide, kSamples, 1, 0, {}}};
    run_cycles(engine->status().program, scene, directory.path(), pictures);
    const Image ours = render_timed(scene, kSamples, 1).result.image;
    EXPECT_NEAR(mean(pictures[0].image) / mean(ours), 1, 5e-3);
    EXPECT_LT(rms_of_difference(pictures[0].image, ours), 0.05 * rms(ours));
    EXPECT_GT(pictures[0].seconds, 0);
  }
}

}  // namespace
}  // namespace lobelia::cost
