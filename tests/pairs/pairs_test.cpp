// The pairs in this folder through the program, at its default limits.
#include <nlohmann/json.hpp>

#include "lobelia_paths.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

const std::string kPairs = std::string(LOBELIA_SOURCE_DIR) + "/tests/pairs/";

nlohmann::json compared(const std::string& folder, int exit_code) {
  const TemporaryDirectory directory;
  const auto result =
      run_lobelia({"compare", kPairs + folder + "/a", kPairs + folder + "/b", "--json", "set.json"},
                  directory.path());
  EXPECT_EQ(result.exit_code, exit_code) << result.output_tail;
  return nlohmann::json::parse(read_file(directory.path() / "set.json", 16 << 20));
}

TEST(Pairs, PassAtTheDefaultLimitsIfTheyMust) {
  const auto set = compared("must_pass", 0);
  EXPECT_GE(set["summary"]["pairs"], 12);
  for (const auto& pair : set["pairs"])
    EXPECT_EQ(pair["comparison"]["verdict"], "pass") << pair["name"];
}

TEST(Pairs, FailAtTheDefaultLimitsIfTheyMust) {
  const auto set = compared("must_fail", 1);
  EXPECT_GE(set["summary"]["pairs"], 29);
  EXPECT_EQ(set["summary"]["nonFinite"], 2);
  for (const auto& pair : set["pairs"])
    EXPECT_NE(pair["comparison"]["verdict"], "pass") << pair["name"];
}

}  // namespace
}  // namespace lobelia
