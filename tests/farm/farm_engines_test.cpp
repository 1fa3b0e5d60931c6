// The farm with the real engines.
#include "base/pictures/image_io.hpp"
#include "compare/compare.hpp"
#include "farm/make_result.hpp"
#include "farm_fixture.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "tests/json.hpp"
#include "tests/reference_scenes/require_engine.hpp"

namespace lobelia {
namespace {

class FarmWithEngines : public FarmTest {
 protected:
  void SetUp() override {
    for (const auto& engine : engine_infos()) {
      require_engine(*make_engine(engine.name, {}));
      if (IsSkipped() || HasFatalFailure()) return;
    }
  }
};

TEST_F(FarmWithEngines, AgreesWithBothEnginesInEveryCell) {
  Grid real = grid("16, 1024", "<engine name=\"povray\"/><engine name=\"blender\"/>");
  // At n = 1024 a smaller picture has its peak between two pixels, and a share of it means little.
  real.scene.film = {128, 128};
  const FarmSummary summary = run_farm(real, out(), {});
  EXPECT_EQ(summary.pass, 2u);
  EXPECT_EQ(summary.rendered, 6u);
  for (const char* id : {"n16", "n1024"})
    for (const char* engine : {"povray", "blender"}) {
      const std::string name = std::string("lobelia-") + engine;
      const Json record = read_json(in_cell(id, name + ".json"));
      EXPECT_EQ(record["verdict"], "pass");
      EXPECT_GT(record["metrics"]["peak"], 1) << "a black picture agrees with nothing";
      EXPECT_TRUE(fs::exists(in_cell(id, name + ".png")));
    }
  EXPECT_EQ(run_farm(real, out(), {}).rendered, 0u);

  // Three black pixels where the highlight is brightest are not three pixels of a silhouette.
  const Scene scene = scene_of(real, cells_of(real).front());
  Image broken = read_image(in_cell("n16", "lobelia.exr"));
  for (int x = 0; x < 3; ++x) {
    const auto values = broken.values();
    const auto at = std::max_element(values.begin(), values.end()) - values.begin();
    for (std::ptrdiff_t c = 0; c < 3; ++c) values[std::size_t(at - at % 3 + c)] = 0;
  }
  for (const char* engine : {"povray", "blender"}) {
    ComparisonOptions options;
    options.tolerance = tolerance_of(scene, {engine_info(engine).floor});
    const Image reference = read_image(in_cell("n16", std::string(engine) + ".exr"));
    const Comparison comparison = compare(broken, reference, options);
    EXPECT_EQ(comparison.value("outliers"), 3) << engine;
    EXPECT_EQ(comparison.verdict, Verdict::kDiffers) << engine;
  }
}

}  // namespace
}  // namespace lobelia
