// The small table of agreement by the real engines, as a user makes it, and with a mistake of a thousandth planted in each.
#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "base/words/text.hpp"
#include "lobelia_paths.hpp"
#include "studies/agreement/agreement.hpp"
#include "tests/json.hpp"
#include "tests/reference_scenes/require_engine.hpp"
#include "tests/test.hpp"

namespace lobelia::agreement {
namespace {

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

/// Multiplies a coefficient by 1.001 in the files of an engine that is told formulas in its own language.
constexpr char kInFiles[] = R"(
sed -i 's|phong albedo Specular/pi|phong albedo 1.001*Specular/pi|' *.inc 2> /dev/null
sed -i 's|lambda n, tail: (n + 2) / (4|lambda n, tail: 1.001 * (n + 2) / (4|' blender_formulas.py 2> /dev/null
exec "$engine" "$@"
)";
/// Multiplies the strength of every highlight by 1.001 in the scenes that one of our programs reads.
constexpr char kInScenes[] = R"(
change() {
  while IFS= read -r line; do
    case $line in
      material*) echo "$line" | awk '{ $4 = sprintf("%.17g", 1.001 * $4); print }' ;;
      *) echo "$line" ;;
    esac
  done < "$1" > "$1-changed"
}
change "$1"
while IFS= read -r file; do
  if [ -n "$file" ]; then change "$file"; file=$file-changed; fi
  echo "$file"
done | "$engine" "$1-changed"
)";

class AgreementWithAMistake : public testing::TestWithParam<std::string> {};

TEST_P(AgreementWithAMistake, IsMissed) {
  const auto engine = make_engine(GetParam(), {});
  require_engine(*engine);
  if (IsSkipped() || HasFatalFailure()) return;
  const TemporaryDirectory directory;
  const fs::path mistaken = directory.path() / "mistaken";
  write_file(mistaken,
             "#!/bin/sh\nengine=" + shell_quote(engine->status().program.string()) +
                 "\nif [ \"$1\" = --version ]; then exec \"$engine\" \"$1\"; fi\n" +
                 (GetParam() == "povray" || GetParam() == "blender" ? kInFiles : kInScenes));
  fs::permissions(mistaken, fs::perms::owner_all);
  ProcessOptions options;
  options.working_directory = directory.path();
  const auto result =
      run_process({LOBELIA_PROGRAM, "verify", "references", "--small", "--size", "16", "--engine",
                   GetParam(), "--" + GetParam(), mistaken.string(), "-q", "-o", "table"},
                  options);
  EXPECT_EQ(result.exit_code, 1) << result.output_tail;
  std::map<std::string, int> missed;
  const Json record = read_json(directory.path() / "table" / "agreement.json");
  for (const Json& row : record["rows"])
    if (row["verdict"] == "missed") ++missed[row["witness"]];
  EXPECT_GE(missed.size(), 1u);
  for (const auto& [witness, rows] : missed)
    EXPECT_THAT(witness, testing::StartsWith(GetParam())) << rows;
}

INSTANTIATE_TEST_SUITE_P(Engines, AgreementWithAMistake, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const EngineInfo& engine : engine_infos())
                             if (engine.is_program) names.emplace_back(engine.name);
                           return names;
                         }()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lobelia::agreement
