// The page of what accuracy costs, from records that anybody may have written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "gallery/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"

namespace lobelia::gallery {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

Json way(const std::string& name, double median, const Json& error) {
  return {
      {"name", name},
      {"settings", {{"lobe", name}}},
      {"seconds",
       {{"median", median}, {"spread", 0.05}, {"least", median}, {"most", median}, {"rounds", 5}}},
      {"errors", {{"max", error}}}};
}

Json cost_record() {
  Json record = make_record("cost");
  record["command"] = {"lobelia", "cost", "a b.xml"};
  record["host"] = {{"processor", "any"}, {"threads", 2}};
  record["tables"] = Json::array(
      {{{"id", "lobe-n64"},
        {"level", "lobe"},
        {"title", "A lobe, n = 64"},
        {"per", "evaluation"},
        {"errors", Json::array({{{"id", "max"}, {"meaning", "largest error of the lobe"}}})},
        {"ways",
         Json::array({way("cs16", 1e-9, 0.017), way("cosine", 2e-9, 1e-7),
                      way("<img src=x onerror=alert(1)>", 9e-9, "nan"), way("slow", 7e-9, 0.5)})},
        {"fronts",
         {{"max",
           {{"ways", {"cs16", "cosine"}},
            {"inWords", {"from cs16 to cosine: 2.0 times the time, 170000 times less error"}}}}}},
        {"remarks", {"a remark & more"}}}});
  return record;
}

class CostPage : public ::testing::Test {
 protected:
  std::filesystem::path put(const Json& record) {
    std::filesystem::create_directories(farm_.directory() / "cost");
    write_record(farm_.directory() / "cost/cost.json", record);
    write_file(farm_.directory() / "cost/cost.csv", "x");
    write_gallery(farm_.directory());
    return farm_.directory() / "cost.html";
  }
  FakeFarm farm_;
};

TEST_F(CostPage, IsThereWithAChartOfEveryWayThatHasAnError) {
  put(cost_record());
  const Site site(farm_.directory());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
  const auto& page = site.page("cost.html");
  EXPECT_EQ(page.select_nodes("//svg").size(), 1u);
  EXPECT_EQ(page.select_nodes("//g[@class='point']").size(), 3u)
      << "one has no error that is known";
  EXPECT_EQ(page.select_nodes("//tbody/tr").size(), 4u);
  EXPECT_EQ(site.page("index.html").select_nodes("//a[@href='cost.html']").size(), 1u);
}

TEST_F(CostPage, SaysWhatTheFrontSaysAndHowItWasMeasured) {
  const std::string text = read_file(put(cost_record()), 1 << 20);
  EXPECT_THAT(text, HasSubstr("from cs16 to cosine: 2.0 times the time"));
  EXPECT_THAT(text, HasSubstr("a remark &amp; more"));
  EXPECT_THAT(text, HasSubstr("lobelia cost &#39;a b.xml&#39;"));
  EXPECT_THAT(text, HasSubstr("&lt;img src=x onerror=alert(1)&gt;"));
  EXPECT_THAT(text, HasSubstr("1.00 ns"));
}

TEST_F(CostPage, ShowsWhatIsCountedWhereThereIsNothingToTime) {
  Json record = cost_record();
  Json& table = record["tables"][0];
  table["unit"] = "bit operations";
  for (Json& one : table["ways"]) {
    one.erase("seconds");
    one["count"] = 1408;
  }
  const std::string text = read_file(put(record), 1 << 20);
  EXPECT_THAT(text, HasSubstr("bit operations per evaluation"));
  EXPECT_THAT(text, HasSubstr("<td class=\"number\">1408</td>"));
}

TEST_F(CostPage, IsNotThereWhereNothingWasMeasured) {
  write_gallery(farm_.directory());
  EXPECT_FALSE(std::filesystem::exists(farm_.directory() / "cost.html"));
  EXPECT_EQ(
      Site(farm_.directory()).page("index.html").select_nodes("//a[@href='cost.html']").size(), 0u);
}

TEST_F(CostPage, OfABrokenRecordSaysSoAndTheGalleryIsThere) {
  const auto broken = [&](auto change) {
    Json record = cost_record();
    change(record);
    const std::string text = read_file(put(record), 1 << 20);
    EXPECT_THAT(text, HasSubstr("It cannot be shown")) << record.dump(1);
    EXPECT_TRUE(std::filesystem::exists(farm_.directory() / "index.html"));
  };
  broken([](Json& r) { r["kind"] = "farm"; });
  broken([](Json& r) { r["tables"] = 3; });
  broken([](Json& r) { r["tables"][0]["ways"][0]["name"] = 3; });
  broken([](Json& r) { r["tables"][0]["ways"][0]["seconds"]["median"] = "fast"; });
}

TEST_F(CostPage, SurvivesNumbersOfAnySize) {
  Json record = cost_record();
  Json& ways = record["tables"][0]["ways"];
  ways.push_back(way("huge", 1e300, 1e300));
  ways.push_back(way("tiny", 1e-300, 1e-300));
  ways.push_back(way("negative", -1, -1));
  ways.push_back(way("endless", 1, "inf"));
  put(record);
  EXPECT_THAT(Site(farm_.directory()).bad_links(), IsEmpty());
  record["tables"][0]["ways"] = Json::array();
  put(record);
  EXPECT_EQ(Site(farm_.directory()).page("cost.html").select_nodes("//g[@class='point']").size(),
            0u);
}

}  // namespace
}  // namespace lobelia::gallery
