// The small table of agreement by the real POV-Ray and the real Blender, as a user makes it.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "core/files.hpp"
#include "core/process.hpp"
#include "lobelia_paths.hpp"
#include "studies/agreement/agreement.hpp"
#include "tests/json.hpp"
#include "tests/reference_scenes/require_engine.hpp"

namespace lobelia::agreement {
namespace {

using testing::HasSubstr;

class AgreementCommand : public testing::Test {
 protected:
  void SetUp() override {
    for (const EngineInfo& engine : engine_infos()) {
      require_engine(*make_engine(engine.name, {}));
      if (IsSkipped() || HasFatalFailure()) return;
    }
  }
};

TEST_F(AgreementCommand, FindsEveryEngineWithinItsFloor) {
  const TemporaryDirectory directory;
  ProcessOptions options;
  options.working_directory = directory.path();
  const auto result = run_process(
      {LOBELIA_PROGRAM, "verify", "references", "--small", "-q", "-o", "table"}, options);
  const Json record = read_json(directory.path() / "table" / "agreement.json");
  EXPECT_EQ(record["verdicts"]["failed"], 0) << result.output_tail;
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  std::map<std::string, int> pictures, refused;
  for (const Json& row : record["rows"]) {
    if (row["verdict"] == "not comparable") {
      ++refused[row["what"]];
      continue;
    }
    ++pictures[row["witness"]];
    EXPECT_NE(row["verdict"], "missed") << row;
  }
  for (const Json& row : record["soft"]) EXPECT_EQ(row["verdict"], "met") << row;
  EXPECT_EQ(record["soft"].size(), 4u);
  const std::size_t highlights = highlight_cases({true, kSmallSize}).size();
  for (const auto* witness : {"ours", "povray_expressed_half", "povray_expressed_float",
                              "blender_expressed", "povray_blender"})
    EXPECT_GT(pictures[witness], int(highlights)) << witness;
  for (const Variant& variant : variants())
    EXPECT_GE(pictures[std::string(variant.name)], 2) << variant.name;
  EXPECT_GE(refused["glossy inter-reflection"], 6);
  EXPECT_GE(refused["light with a size in a mirror"], 6);
  // By all but Blender's nodes and the formulas.
  EXPECT_EQ(refused["mirrors of a highlight that an engine is told"],
            std::ranges::count_if(variants(), [](const Variant& variant) {
              return variant.name != "blender_expressed";
            }));
  EXPECT_THAT(read_file(directory.path() / "table" / "agreement.md", 1 << 20),
              HasSubstr("`lobelia verify references --small`: pictures 64 pixels wide"));
  EXPECT_THAT(read_file(directory.path() / "table" / "agreement.csv", 1 << 22),
              HasSubstr("\nhighlight,"));
}

}  // namespace
}  // namespace lobelia::agreement
