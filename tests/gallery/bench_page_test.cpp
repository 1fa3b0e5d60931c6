// The page of speed, from records that anybody may have written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gallery/gallery.hpp"
#include "records/bench.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"

namespace lobelia::gallery {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

records::BenchGoal measured(const std::string& id, double ratio, double goal, bool at_least) {
  records::BenchGoal made;
  made.id = id;
  made.what = "what " + id + " is";
  made.unit = "s";
  made.against = "its peer";
  made.ours = {2e-3, 0.01, 1e-3, 3e-3, 5};
  made.other = {0.2, 0.01, 0.1, 0.3, 5};
  made.ratio = {ratio, 0.03, ratio, ratio, 5};
  made.goal = goal;
  made.at_least = at_least;
  made.met = at_least ? ratio >= goal : ratio <= goal;
  return made;
}

records::BenchRun run_of(const std::string& commit, double ratio) {
  records::BenchRun run;
  run.commit = commit;
  run.committed = "2026-01-31";
  run.host.processor = "A processor";
  run.host.threads = 2;
  run.instruction_set = "AVX2";
  run.goals = {measured("kernel.cosine", ratio, 100, true), measured("scale.plan", 0.4, 1, false)};
  run.left_out = {{"compare.flip", "no flip here"}};
  return run;
}

class BenchPage : public ::testing::Test {
 protected:
  Site site_of(const records::Bench& record) {
    const auto directory = farm_.directory() / "bench";
    std::filesystem::create_directories(directory);
    write_file(directory / "bench.json", record_text(record));
    write_gallery(farm_.directory());
    return Site(farm_.directory());
  }
  std::string text() const { return read_file(farm_.directory() / "bench.html", 1 << 22); }
  FakeFarm farm_;
};

TEST_F(BenchPage, ShowsTheLastRunAndEachGoalOverAllThatHaveIt) {
  records::Bench record{{run_of("abc1", 84), run_of("abc2", 96), run_of("abc3", 112)}};
  record.runs[0].goals.pop_back();
  const Site site = site_of(record);
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
  const auto& page = site.page("bench.html");
  EXPECT_EQ(page.select_nodes("//tbody/tr").size(), 2u);
  ASSERT_EQ(page.select_nodes("//figure").size(), 2u);
  EXPECT_EQ(page.select_nodes("//figure[1]//g[@class='point']").size(), 3u);
  EXPECT_EQ(page.select_nodes("//figure[2]//g[@class='point']").size(), 2u);
  EXPECT_THAT(text(), HasSubstr("2 of 2 goals of speed are met by abc3 of 2026-01-31."));
  EXPECT_THAT(text(), HasSubstr("compare.flip was not measured: no flip here."));
  EXPECT_THAT(text(), HasSubstr("abc1 of 2026-01-31: 84"));
}

TEST_F(BenchPage, DrawsNoChartOfOnePoint) {
  const Site site = site_of({{run_of("abc1", 84)}});
  EXPECT_EQ(site.page("bench.html").select_nodes("//svg").size(), 0u);
  EXPECT_THAT(text(), HasSubstr("There is one run so far."));
  EXPECT_THAT(text(), HasSubstr("1 of 2 goals of speed are met"));
}

TEST_F(BenchPage, IsSafeWhateverTheRecordSays) {
  records::Bench record{{run_of("<img src=x>", 1e300), run_of("b", 0)}};
  record.runs[1].goals[0].what = "<script>alert(1)</script>";
  record.runs[1].goals[1].unit = "\"><b>";
  record.runs[1].left_out = {{"a", "<i>"}};
  EXPECT_THAT(site_of(record).active_content(), IsEmpty());
  EXPECT_THAT(text(), Not(HasSubstr("<script>alert(1)")));
  EXPECT_THAT(text(), Not(HasSubstr("<img src=x>")));
  site_of({});
  EXPECT_THAT(text(), HasSubstr("Nothing was measured."));
}

}  // namespace
}  // namespace lobelia::gallery
