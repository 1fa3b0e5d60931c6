// The small table of agreement by the real POV-Ray and the real Blender, as a user makes it.
#include <gmock/gmock.h>

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

/// Targets that are known to be missed (docs/agreement.md says why), and what witnesses are held to instead.
/// Beside each is the worst of the full table.
struct KnownMiss {
  std::string_view witness;
  double from_exponent;
  const char* figure;
  double limit;
};
constexpr KnownMiss kKnownMisses[] = {
    {"povray_native_float", 0, "maxRelative", 5e-7},     // 4.2e-7
    {"povray_expressed_float", 0, "maxRelative", 5e-7},  // 3.4e-7
    {"blender_expressed", 1e5, "maxOfPeak", 1.2e-4},     // 9.4e-5
    {"blender_native", 1e5, "maxOfPeak", 2.2e-2},        // 1.7e-2
    {"blender_native", 1024, "maxOfPeak", 2e-4},         // 1.6e-4
};

bool is_known(const Json& row) {
  for (const KnownMiss& known : kKnownMisses)
    if (row["witness"] == known.witness && row["exponent"] >= known.from_exponent)
      return row[known.figure] <= known.limit;
  return false;
}

class AgreementCommand : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"povray", "blender"}) {
      require_engine(*make_engine(name, {}));
      if (IsSkipped() || HasFatalFailure()) return;
    }
  }
};

TEST_F(AgreementCommand, FindsEveryWitnessWithinItsTargetButWhereTheDocumentationSaysWhyNot) {
  const TemporaryDirectory directory;
  ProcessOptions options;
  options.working_directory = directory.path();
  const auto result = run_process(
      {LOBELIA_PROGRAM, "verify", "references", "--small", "-q", "-o", "table"}, options);
  const Json record = read_json(directory.path() / "table" / "agreement.json");
  EXPECT_EQ(record["verdicts"]["failed"], 0) << result.output_tail;
  EXPECT_EQ(result.exit_code, record["verdicts"]["missed"] > 0 ? 1 : 0) << result.output_tail;
  std::map<std::string, int> pictures, refused;
  for (const Json& row : record["rows"]) {
    if (row["verdict"] == "not comparable") {
      ++refused[row["what"]];
      continue;
    }
    ++pictures[row["witness"]];
    EXPECT_LE(row["ring"]["over"], row["witness"] == "blender_native" && row["exponent"] >= 1e5
                                       ? row["ring"]["pixels"]
                                       : row["ring"]["allowed"])
        << row;
    EXPECT_TRUE(row["verdict"] != "missed" || is_known(row)) << row;
  }
  for (const Json& row : record["soft"]) EXPECT_EQ(row["verdict"], "met") << row;
  EXPECT_EQ(record["soft"].size(), 4u);
  const std::size_t highlights = highlight_cases({true, kSmallSize}).size();
  for (const auto* witness : {"ours", "povray_expressed_half", "povray_expressed_float",
                              "blender_expressed", "povray_blender"})
    EXPECT_GT(pictures[witness], int(highlights)) << witness;
  for (const Variant& variant : variants())
    EXPECT_GE(pictures[std::string(variant.name)], 3) << variant.name;
  EXPECT_GE(refused["glossy inter-reflection"], 6);
  EXPECT_GE(refused["light with a size in a mirror"], 6);
  EXPECT_EQ(refused["mirrors of a highlight that an engine is told"], 5)
      << "all but Blender's nodes";
  EXPECT_THAT(read_file(directory.path() / "table" / "agreement.md", 1 << 20),
              HasSubstr("`lobelia verify references --small`: pictures 64 pixels wide"));
  EXPECT_THAT(read_file(directory.path() / "table" / "agreement.csv", 1 << 22),
              HasSubstr("\nhighlight,"));
}

}  // namespace
}  // namespace lobelia::agreement
