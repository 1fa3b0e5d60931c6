#include "studies/cost/benchmarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "studies/cost/convergence.hpp"
#include "studies/cost/scenes.hpp"

namespace lobelia::cost {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using Directions = Experiment::Directions;

/// Without Blender, which is asked for in tests with the label engines.
Options quick() {
  Options options;
  options.effort = Effort::kQuick;
  options.programs = {{"blender", "/nowhere/blender"}};
  return options;
}

class Transport : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Options options = quick();
    options.scenes = {{"all", everything()}};
    options.scenes.push_back({"still", everything()});
    Scene& still = options.scenes.back().scene;
    still.lights = {PointLight{{0, 3, 3}, {9, 9, 9}}};
    still.camera.aperture_radius = 0;
    still.depth.glossy = 0;
    tables_ = new std::vector<Table>(measure_transport(options));
  }
  static void TearDownTestSuite() { delete tables_; }
  static inline std::vector<Table>* tables_ = nullptr;
};

TEST_F(Transport, HasATableForEachKindOfSceneAndEachGivenThatIsRandom) {
  std::vector<std::string> ids;
  for (const Table& table : *tables_) ids.push_back(table.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"transport-rectangle_light", "transport-environment",
                                           "transport-inter_reflection", "transport-all"}));
}

TEST_F(Transport, ErrorsOfImportanceSamplingFallWithSamples) {
  for (const Table& table : *tables_) {
    std::vector<double> errors;
    for (const Variant& variant : table.variants) {
      ASSERT_TRUE(variant.error_spreads) << variant.name;
      EXPECT_EQ(variant.error_spreads->size(), 1u);
      if (variant.name.starts_with("ours, ") && variant.settings[1].second.ends_with("as planned"))
        errors.push_back(variant.errors[0].second);
    }
    ASSERT_EQ(errors.size(), 3u);
    EXPECT_GT(errors[0], 1.5 * errors[1]) << table.id;
    EXPECT_GT(errors[1], 1.5 * errors[2]) << table.id;
    EXPECT_EQ(table.variants.size(), 9u) << "three variants to draw directions";
  }
}

TEST_F(Transport, ImportanceSamplingHasLessErrorWithAsManySamples) {
  for (const Table& table : *tables_) {
    std::map<std::string, double> at_16;
    for (const Variant& variant : table.variants)
      if (setting(variant, "samples") == 16) at_16[variant.name] = variant.errors[0].second;
    EXPECT_LT(at_16.at("ours, 16"), at_16.at("ours, evenly, 16")) << table.id;
  }
}

TEST_F(Transport, SaysWhatIsMissingAndWhatWasFitted) {
  for (const Table& table : *tables_) {
    EXPECT_THAT(table.remarks, Contains(HasSubstr("without Cycles: ")));
    EXPECT_THAT(table.remarks,
                Contains(HasSubstr("ours: the error falls as the samples to the power -")));
    EXPECT_THAT(table.remarks, Contains(HasSubstr("an error of 1e-02 takes")));
  }
}

/// Means of a picture by other ways to draw directions; `relative`: of the planned ones.
void expect_the_same_light(const Scene& scene, Directions directions, int samples,
                           double relative) {
  RenderOptions how;
  how.experiment.directions = directions;
  const double planned = mean(render_timed(scene, 64, 1).result.image);
  EXPECT_NEAR(mean(render_timed(scene, samples, 2, how).result.image) / planned, 1, relative);
}

TEST(Directions, HoweverTheyAreDrawnBringTheSameLight) {
  Scene scene = everything();
  scene.film = {16, 16};
  for (const Directions directions : {Directions::kLight, Directions::kSurface, Directions::kEven})
    expect_the_same_light(scene, directions, 4096, 0.01);
  expect_the_same_light(with_inter_reflection(below_rectangle(16)), Directions::kEven, 4096, 0.02);
}

TEST(Directions, ByTheLightAloneScatterNoRaysAndBySurfaceAloneCastNoShadowRays) {
  RenderOptions how;
  how.experiment.directions = Directions::kSurface;
  const Work surface = render_timed(below_rectangle(16), 4, 1, how).result.work;
  EXPECT_EQ(surface.shadow_rays, 0u);
  EXPECT_GT(surface.scattered_rays, 0u);
  how.experiment.directions = Directions::kLight;
  const Work light = render_timed(below_sky(16), 4, 1, how).result.work;
  EXPECT_GT(light.shadow_rays, 0u);
  EXPECT_EQ(light.scattered_rays, 0u);
}

}  // namespace
}  // namespace lobelia::cost
