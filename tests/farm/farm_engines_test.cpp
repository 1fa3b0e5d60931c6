// The farm with the real engines.
#include "farm_fixture.hpp"
#include "reference_scenes/engine.hpp"
#include "tests/reference_scenes/require_engine.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

class FarmWithEngines : public FarmTest {
 protected:
  void SetUp() override {
    for (const auto& engine : engine_infos()) {
      require_engine(*make_engine(engine.name, {}));
      if (IsSkipped() || HasFatalFailure()) return;
    }
  }
};

TEST_F(FarmWithEngines, EveryCellAgreesWithPovRayAndBlenderAndIsNotMadeTwice) {
  const Grid real = grid("16, 1024", "<engine name=\"povray\"/><engine name=\"blender\"/>");
  FarmSummary summary = run_farm(real, out(), {});
  EXPECT_EQ(summary.pass, 2u);
  EXPECT_EQ(summary.rendered, 6u);
  for (const char* id : {"n16", "n1024"})
    for (const char* engine : {"povray", "blender"}) {
      const std::string name = std::string("lobelia-") + engine;
      const Json record = read_record(in_cell(id, name + ".json"), "comparison");
      EXPECT_EQ(record["verdict"], "pass");
      EXPECT_GT(record["metrics"]["peak"], 1) << "a black picture agrees with nothing";
      EXPECT_TRUE(fs::exists(in_cell(id, name + ".png")));
    }
  EXPECT_EQ(run_farm(real, out(), {}).rendered, 0u);
  fs::remove(in_cell("n16", "povray.exr"));
  summary = run_farm(real, out(), {});
  EXPECT_EQ(summary.rendered, 1u);
  EXPECT_EQ(summary.pass, 2u);
}

}  // namespace
}  // namespace lobelia
