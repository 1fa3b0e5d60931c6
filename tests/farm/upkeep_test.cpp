#include "farm/upkeep.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "core/error.hpp"
#include "farm/failed_jobs.hpp"
#include "farm/result_cache.hpp"
#include "farm_fixture.hpp"
#include "tests/json.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class UpkeepTest : public FarmTest {
 protected:
  UpkeepTest() { run_farm(grid("16, 32", "<engine name=\"analytic\"/>"), out(), {}); }
  fs::path cache() const { return out() / "cache"; }
  /// Other bytes in place of a file's, with the time of change that it had.
  static void corrupt(const fs::path& file) {
    const auto age = fs::last_write_time(file);
    const std::string whole = read_file(file, 1 << 24);
    fs::permissions(file, fs::perms::owner_all);
    std::ofstream(file, std::ios::binary) << std::string(whole.size(), '!');
    fs::last_write_time(file, age);
  }
};

TEST_F(UpkeepTest, VerifyFindsWhatAFarmBelievesAndTheNextFarmMakesOnlyThatAgain) {
  EXPECT_TRUE(verify_cache(cache(), false, {}).damaged.empty());
  corrupt(in_cell("n16", "lobelia.exr"));
  EXPECT_EQ(run_farm(grid("16, 32", "<engine name=\"analytic\"/>"), out(), {}).work.made, 0u);
  for (const bool remove : {false, true}) {
    const VerifyReport report = verify_cache(cache(), remove, {});
    EXPECT_EQ(report.results, 8u);
    ASSERT_EQ(report.damaged.size(), 1u);
    EXPECT_THAT(report.damaged[0], HasSubstr("lobelia.exr has another content"));
  }
  EXPECT_EQ(verify_cache(cache(), false, {}).results, 7u);
  EXPECT_EQ(run_farm(grid("16, 32", "<engine name=\"analytic\"/>"), out(), {}).work.made, 1u)
      << "the same bytes again, so that what was made of them still holds";
  EXPECT_TRUE(verify_cache(cache(), false, {}).damaged.empty());
}

TEST_F(UpkeepTest, VerifyOpensWhatItsHashSaysIsWhole) {
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

TEST_F(UpkeepTest, AFarmUsesWhatItTouchesSoThatGarbageIsSomethingElse) {
  const ResultCache results(cache());
  const auto old = fs::last_write_time(cache()) - std::chrono::hours(1000);
  for (const auto& key : results.list()) fs::last_write_time(results.result_directory(key), old);
  run_farm(grid("16", "<engine name=\"analytic\"/>"), out(), {});
  std::size_t used = 0;
  for (const auto& key : results.list())
    used += fs::last_write_time(results.result_directory(key)) != old;
  EXPECT_EQ(used, 4u);
}

TEST_F(UpkeepTest, TakesNothingAwayUnderAFarmThatIsAtWork) {
  const ResultCache results(cache());
  const auto in_use = results.try_use(true);
  EXPECT_THROW(collect_garbage(cache(), 0), Error);
  EXPECT_EQ(results.list().size(), 8u);
  EXPECT_EQ(as_json(farm_status(out())).at("atWork"), true);
}

TEST_F(UpkeepTest, CleanTakesAwayWhatIsNotOfTheGridAndNothingElse) {
  run_farm(grid("16"), out(), {});
  write_file(out() / "index.html", "a gallery");
  CleanReport report = clean_farm(out(), false);
  EXPECT_EQ(report.cells, 1u);
  EXPECT_TRUE(fs::exists(in_cell("n16", "cell.json")));
  EXPECT_FALSE(fs::exists(in_cell("n32", "")));
  report = clean_farm(out(), true);
  EXPECT_FALSE(fs::exists(out() / "cells"));
  EXPECT_TRUE(fs::exists(out() / "index.html"));
  EXPECT_EQ(ResultCache(cache()).list().size(), 9u)
      << "two cells with the formulas, and a profile of one without";
  EXPECT_THROW(clean_farm(out(), false), Error) << "it is no farm's directory any more";
  EXPECT_THROW(clean_farm(directory_.path(), true), Error);
}

TEST_F(UpkeepTest, CleanTakesAwayWhatFailedJobsLeft) {
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

TEST_F(UpkeepTest, StatusTellsWhatHasBecomeOfEachCell) {
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
