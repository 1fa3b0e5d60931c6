#include "farm/upkeep.hpp"

#include "base/system/error.hpp"
#include "farm/failed_jobs.hpp"
#include "farm/result_cache.hpp"
#include "farm_fixture.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class UpkeepTest : public FarmTest {
 protected:
  UpkeepTest() { run_farm(grid("16, 32", "<engine name=\"analytic\"/>"), out(), {}); }
  fs::path cache() const { return out() / "cache"; }
};

TEST_F(UpkeepTest, OpensFilesWithASoundHash) {
  // As a program that publishes rubbish would leave it.
  const ResultCache results(cache());
  ResultDraft draft = results.draft();
  write_file(draft.file("a.exr"), "no picture");
  write_file(draft.file("b.json"), "{");
  records::Result rubbish;
  rubbish.job = "render";
  results.publish(draft, result_key({"rubbish"}), rubbish);
  const VerifyReport report = verify_cache(cache(), false, {});
  ASSERT_EQ(report.damaged.size(), 1u);
  EXPECT_THAT(report.damaged[0], HasSubstr("is not JSON"));
}

TEST_F(UpkeepTest, GarbageGoesFromTheLeastUsedUntilTheRestFits) {
  const ResultCache results(cache());
  const auto keys = results.list();
  const auto old = fs::last_write_time(cache()) - std::chrono::hours(1000);
  for (const auto& key : keys)
    if (key != keys[3]) fs::last_write_time(results.result_directory(key), old);
  const GcReport all = collect_garbage(cache(), std::nullopt);
  EXPECT_EQ(all.kept, 8u);
  EXPECT_EQ(all.removed, 0u);
  const GcReport half = collect_garbage(cache(), all.kept_bytes / 2);
  EXPECT_LE(half.kept_bytes, all.kept_bytes / 2);
  EXPECT_EQ(half.kept + half.removed, 8u);
  EXPECT_EQ(half.kept_bytes + half.removed_bytes, all.kept_bytes);
  EXPECT_TRUE(results.has(keys[3])) << "it was used last";
  EXPECT_EQ(collect_garbage(cache(), 0).kept, 0u);
  EXPECT_TRUE(fs::exists(in_cell("n16", "lobelia.exr")))
      << "a farm's own directory keeps its files";
  EXPECT_EQ(run_farm(grid("16, 32", "<engine name=\"analytic\"/>"), out(), {}).work.made, 8u);
}

TEST_F(UpkeepTest, MarksResultsAsUsedByAFarm) {
  const ResultCache results(cache());
  const auto old = fs::last_write_time(cache()) - std::chrono::hours(1000);
  for (const auto& key : results.list()) fs::last_write_time(results.result_directory(key), old);
  run_farm(grid("16", "<engine name=\"analytic\"/>"), out(), {});
  std::size_t used = 0;
  for (const auto& key : results.list())
    used += fs::last_write_time(results.result_directory(key)) != old;
  EXPECT_EQ(used, 4u);
}

TEST_F(UpkeepTest, CleansFilesOfFailedJobs) {
  const fs::path failed = out() / FailedJobs::kName;
  FarmOptions options;
  options.attempts = 1;
  options.failed_directory = failed;
  options.programs = {{"povray", failing_povray()}};
  run_farm(grid("16, 32", "<engine name=\"povray\"/>"), out(), options);
  ASSERT_TRUE(fs::exists(failed / "n16") && fs::exists(failed / "n32"));
  run_farm(grid("16", "<engine name=\"povray\"/>"), out(), options);
  clean_farm(out(), false);
  EXPECT_TRUE(fs::exists(failed / "n16"));
  EXPECT_FALSE(fs::exists(failed / "n32"));
  write_file(failed / "mine", "a user's");
  const CleanReport report = clean_farm(out(), true);
  EXPECT_FALSE(fs::exists(failed / "n16"));
  EXPECT_TRUE(fs::exists(failed / "mine"));
  EXPECT_THAT(report.stays, testing::Contains(testing::HasSubstr("failed")));
}

TEST_F(UpkeepTest, PrintsTheStatusOfEachCell) {
  Json status = as_json(farm_status(out()));
  EXPECT_EQ(status.at("cells"), 2);
  EXPECT_EQ(status.at("status").at("pass"), 2);
  EXPECT_EQ(status.at("atWork"), false);
  EXPECT_TRUE(status.at("failures").empty());
  FarmOptions options;
  options.attempts = 2;
  options.programs = {{"povray", failing_povray()}};
  run_farm(grid("16", "<engine name=\"povray\"/>"), out(), options);
  status = as_json(farm_status(out()));
  EXPECT_EQ(status.at("status").at("failed"), 1);
  ASSERT_EQ(status.at("failures").size(), 1u);
  EXPECT_EQ(status.at("failures")[0].at("failure"), "exit code");
  EXPECT_EQ(status.at("failures")[0].at("attempts"), 2);
}

TEST(ParseSize, ReadsPowersOf1024AndRefusesTheRest) {
  EXPECT_EQ(parse_size("0"), 0u);
  EXPECT_THROW(parse_size("17"), Error);
  EXPECT_EQ(parse_size("17B"), 17u);
  EXPECT_EQ(parse_size("2K"), 2048u);
  EXPECT_EQ(parse_size("1.5 GB"), 1610612736u);
  EXPECT_EQ(parse_size("3t"), std::uint64_t{3} << 40);
  for (const char* bad : {"", "G", "-1", "1X", "1GG", "nan", "inf", "1e30", "1 0"})
    EXPECT_THROW(parse_size(bad), Error) << bad;
}

}  // namespace
}  // namespace lobelia
