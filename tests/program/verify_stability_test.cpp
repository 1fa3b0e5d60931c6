#include "run_lobelia.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(VerifyStability, WritesARecord) {
  const TemporaryDirectory directory;
  const auto result = run_lobelia(
      {"verify", "stability", "--lobe", "cs12", "-q", "--json", "s.json"}, directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr(" within their bounds, 0 outside,"));
  const Json record = read_json(directory.path() / "s.json");
  EXPECT_EQ(record["outside"], 0);
  EXPECT_LT(record["notCompared"], 100);
  EXPECT_GT(record["cases"], 2500);
  ASSERT_EQ(record["byLobe"].size(), 7u);
  for (const auto& group : record["byLobe"]) EXPECT_EQ(group["lobe"], "cs12");
  EXPECT_EQ(files_in(directory.path()), 1u);
}

TEST(VerifyReferences, EndsWith5WhereAnEngineFails) {
  const TemporaryDirectory directory;
  const auto povray = directory.path() / "povray";
  write_file(povray,
             "#!/bin/sh\n"
             "echo 'POV-Ray 3.7.0.10' >&2\n"
             "case \"$*\" in *version*) exit 0;; esac\n"
             "exit 3\n");
  std::filesystem::permissions(povray, std::filesystem::perms::owner_all);
  const auto result = run_lobelia({"verify", "references", "--small", "--size", "16", "--engine",
                                   "povray", "--povray", povray.string(), "-q", "-o", "table"},
                                  directory.path());
  EXPECT_EQ(result.exit_code, 5) << result.output_tail;
  EXPECT_GT(read_json(directory.path() / "table" / "agreement.json")["verdicts"]["failed"], 100);
  EXPECT_THAT(result.output_tail, HasSubstr(" comparisons, none misses its target, "));
}

}  // namespace
}  // namespace lobelia
