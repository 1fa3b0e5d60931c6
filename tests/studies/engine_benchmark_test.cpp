// The cost of engines and their own light transport, against ours and on scenes that they refuse.
#include "studies/cost/benchmarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "lobelia_paths.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/cost/convergence.hpp"
#include "studies/cost/scenes.hpp"
#include "tests/json.hpp"
#include "tests/reference_scenes/require_engine.hpp"

namespace lobelia::cost {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Scene example(const std::string& file) {
  return read_scene(std::string(LOBELIA_SOURCE_DIR) + "/reference_scenes/scenes/" + file);
}

Options quick(const std::string& file) {
  Options options;
  options.effort = Effort::kQuick;
  options.scenes = {{"scene", example(file)}};
  options.programs = {{"lobelia", LOBELIA_PROGRAM}};
  return options;
}

Options without_engines(const std::string& file) {
  Options options = quick(file);
  options.programs.emplace_back("povray", "/nowhere/povray");
  options.programs.emplace_back("blender", "/nowhere/blender");
  return options;
}

TEST(EngineLevel, MeasuresOurselvesInStagesAndTheFormulasWhereNoEngineIs) {
  const Table table = measure_engines(without_engines("two_lights.xml")).at(0);
  ASSERT_EQ(table.variants.size(), 2u);
  EXPECT_EQ(table.id, "engine-scene");
  EXPECT_EQ(table.variants[0].name, "ours");
  EXPECT_LT(table.variants[0].errors[0].second, 1e-6);
  EXPECT_LT(table.variants[1].errors[0].second, 1e-7);
  for (const char* remark : {"without POV-Ray: ", "without Blender Cycles: ", "ours: start "})
    EXPECT_THAT(table.remarks, Contains(HasSubstr(remark)));
  double sum = 0;
  for (const char* stage : {"start", "parse", "trace", "write"}) {
    const double* seconds = records::find(*table.variants[0].facts->stage_seconds, stage);
    ASSERT_TRUE(seconds) << stage;
    EXPECT_GT(*seconds, 0) << stage;
    sum += *seconds;
  }
  EXPECT_NEAR(sum, cost_of(table.variants[0]).median, 1e-9) << "of one round";
}

TEST(EngineLevel, SaysWhyASceneWithoutTruthIsNotMeasured) {
  const Table table = measure_engines(without_engines("effects/area_light.xml")).at(0);
  EXPECT_THAT(table.variants, IsEmpty());
  EXPECT_THAT(table.remarks, Contains(HasSubstr("a light with a size")));
}

class EngineLevelWithEngines : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"povray", "blender"}) {
      const auto engine = make_engine(name, {});
      require_engine(*engine);
    }
  }
};

TEST_F(EngineLevelWithEngines, RanksTheirNumberFormatsByError) {
  const Table table = measure_engines(quick("two_lights.xml")).at(0);
  std::map<std::string, const Variant*> variants;
  for (const Variant& variant : table.variants) variants[variant.name] = &variant;
  ASSERT_EQ(variants.size(), 5u);
  const Variant &half = *variants.at("POV-Ray, half"), &fine = *variants.at("POV-Ray, float"),
                &cycles = *variants.at("Blender Cycles");
  EXPECT_GT(half.errors[0].second, 1e-5);
  EXPECT_LT(half.errors[0].second, 6e-4);
  EXPECT_LT(fine.errors[0].second, 1e-5);
  EXPECT_LT(cycles.errors[0].second, 1e-4);
  EXPECT_GT(cycles.errors[0].second, 1e-8);
  EXPECT_TRUE(records::find(*half.facts->stage_seconds, "trace"));
  EXPECT_FALSE(records::find(*half.facts->stage_seconds, "start")) << "POV-Ray does not tell";
  for (const char* stage : {"start", "parse", "trace", "write"})
    EXPECT_GT(*records::find(*cycles.facts->stage_seconds, stage), 0) << stage;
}

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
