// The page of what accuracy costs, from records that anybody may have written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "gallery/gallery.hpp"
#include "records/cost.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"

namespace lobelia::gallery {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

records::CostVariant variant(const std::string& name, double median, double error) {
  records::CostVariant variant;
  variant.name = name;
  variant.settings = {{"lobe", name}};
  variant.errors = {{"max", error}};
  variant.seconds = {median, 0.05, median, median, 5};
  return variant;
}

records::Cost cost_record() {
  records::CostTable table;
  table.id = "lobe-n64";
  table.level = "lobe";
  table.title = "A lobe, n = 64";
  table.unit = "s";
  table.per = "evaluation";
  table.errors = {{"max", "largest error of the lobe"}};
  table.variants = {variant("cs16", 1e-9, 0.017), variant("cosine", 2e-9, 1e-7),
                    variant("<img src=x onerror=alert(1)>", 9e-9, std::nan("")),
                    variant("slow", 7e-9, 0.5)};
  table.fronts = {{"max",
                   {{"cs16", "cosine"},
                    {},
                    {"from cs16 to cosine: 2.0 times the time, 170000 times less error"},
                    "lobe-n64-max.svg"}}};
  table.remarks = {"a remark & more"};
  records::Cost record;
  record.command = {"lobelia", "cost", "a b.xml"};
  record.host = {"any", 2, "Debian", ""};
  record.tables = {table};
  return record;
}

class CostPage : public ::testing::Test {
 protected:
  std::filesystem::path put(const records::Cost& record) { return put(record_text(record)); }
  std::filesystem::path put(const std::string& record) {
    std::filesystem::create_directories(farm_.directory() / "cost");
    write_file(farm_.directory() / "cost/cost.json", record);
    write_file(farm_.directory() / "cost/cost.csv", "x");
    write_gallery(farm_.directory());
    return farm_.directory() / "cost.html";
  }
  FakeFarm farm_;
};

TEST_F(CostPage, IsThereWithAChartOfEveryVariantThatHasAnError) {
  put(cost_record());
  const Site site(farm_.directory());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
  const auto& page = site.page("cost.html");
  EXPECT_EQ(page.select_nodes("//svg").size(), 2u) << "for a screen and for a phone";
  EXPECT_EQ(page.select_nodes("//div[@class='wide']//g[@class='point']").size(), 3u)
      << "one has no error that is known";
  EXPECT_EQ(page.select_nodes("//tbody/tr").size(), 4u);
  EXPECT_EQ(site.page("index.html").select_nodes("//nav//a[@href='cost.html']").size(), 1u);
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
  records::Cost record = cost_record();
  record.tables[0].unit = "bit operations";
  for (records::CostVariant& one : record.tables[0].variants) {
    one.seconds.reset();
    one.count = 1408;
  }
  const std::string text = read_file(put(record), 1 << 20);
  EXPECT_THAT(text, HasSubstr("bit operations per evaluation"));
  EXPECT_THAT(text, HasSubstr("<td class=\"number\">1408</td>"));
}

TEST_F(CostPage, FindsTheStepThatBuysTheLeastAccuracyForItsTime) {
  records::Cost record = cost_record();
  std::vector<records::CostVariant>& variants = record.tables[0].variants;
  variants = {variant("cs16", 1e-9, 0.02), variant("dear", 8e-9, 0.01),
              variant("cheap", 16e-9, 1e-7)};
  record.tables[0].fronts[0].second.variants = {"cs16", "dear", "cheap"};
  put(record);
  EXPECT_THAT(read_file(farm_.directory() / "index.html", 1 << 20),
              HasSubstr("The most expensive accuracy: “dear” takes 8 times as long as “cs16”, for "
                        "an error 2 times as small (A lobe, n = 64)."));
}

TEST_F(CostPage, NumbersEveryPointOfACrowdedChartOfAPhone) {
  records::Cost record = cost_record();
  std::vector<records::CostVariant>& variants = record.tables[0].variants;
  variants.clear();
  for (int i = 0; i < 72; ++i) {
    // Two decades of time, six of error, and one at the other end of the axis: as those of a lobe.
    const double across = std::fmod(i * 0.618, 1), down = std::fmod(i * 0.414, 1);
    variants.push_back(variant("v" + std::to_string(i), 1e-9 * std::pow(10, 2 * across),
                               i == 0 ? 1e-16 : std::pow(10, -6 * down)));
  }
  record.tables[0].fronts[0].second.variants = {"v0"};
  put(record);
  const Site site(farm_.directory());
  const auto& page = site.page("cost.html");
  EXPECT_EQ(page.select_nodes("//div[@class='narrow']//g[@class='point']").size(), 72u);
  EXPECT_GE(page.select_nodes("//div[@class='narrow']//*[@class='point-name']").size(), 70u);
}

TEST_F(CostPage, HasNoChartOfOnePointAndSaysWhatOneRunTells) {
  records::Cost record = cost_record();
  std::vector<records::CostVariant>& variants = record.tables[0].variants;
  variants.resize(1);
  variants[0].seconds->rounds = 1;
  variants[0].seconds->spread = 0;
  record.tables[0].fronts = {{"max", {{"cs16"}, {}, {}, "x.svg"}}};
  const std::string text = read_file(put(record), 1 << 20);
  EXPECT_EQ(Site(farm_.directory()).page("cost.html").select_nodes("//svg").size(), 0u);
  EXPECT_THAT(text, HasSubstr("Only “cs16” was measured"));
  EXPECT_THAT(text, HasSubstr("<td class=\"number\">one run</td>"));
  EXPECT_THAT(text, Not(HasSubstr("± 0 %")));
}

TEST_F(CostPage, HasAFindingTitlesAndTheStudysOwnDrawing) {
  records::Cost record = cost_record();
  record.tables[0].variants[1].errors = {{"max", 0}};
  record.command = {"lobelia", "cost", "/srv/someone/scene.xml"};
  std::filesystem::create_directories(farm_.directory() / "cost");
  write_file(farm_.directory() / "cost/lobe-n64-max.svg", "<svg><title>x</title></svg>");
  const std::string text = read_file(put(record), 1 << 20);
  EXPECT_THAT(text,
              HasSubstr("The fastest is “cs16”, with 1.00 ns and an error of 0.017. The least "
                        "error has “cosine”, with 2.00 ns and no error: 2 times the time."));
  EXPECT_THAT(text, HasSubstr("<th scope=\"col\">largest error of the lobe</th>"));
  EXPECT_THAT(text, HasSubstr("href=\"cost/lobe-n64-max.svg\""));
  EXPECT_THAT(text, HasSubstr(">0</text>")) << "the error of 0 has a place on the axis";
  EXPECT_THAT(text, Not(HasSubstr("/srv/someone")));
  EXPECT_THAT(Site(farm_.directory()).bad_links(), IsEmpty());
  write_file(farm_.directory() / "cost/lobe-n64-max.svg", "<svg><script>1</script></svg>");
  EXPECT_THAT(read_file(put(record), 1 << 20), Not(HasSubstr("href=\"cost/lobe-n64-max.svg\"")));
}

TEST_F(CostPage, IsNotThereWhereNothingWasMeasured) {
  write_gallery(farm_.directory());
  EXPECT_FALSE(std::filesystem::exists(farm_.directory() / "cost.html"));
  EXPECT_EQ(
      Site(farm_.directory()).page("index.html").select_nodes("//a[@href='cost.html']").size(), 0u);
}

TEST_F(CostPage, OfABrokenRecordSaysSoAndTheGalleryIsThere) {
  const std::string whole = record_text(cost_record());
  const std::pair<const char*, const char*> changes[] = {
      {R"("kind": "cost")", R"("kind": "farm")"},
      {R"("tables": [)", R"("tables": 3, "others": [)"},
      {R"("name": "cs16")", R"("name": 3)"},
      {R"("median": 1e-09)", R"("median": "fast")"}};
  for (const auto& [from, to] : changes) {
    std::string broken = whole;
    ASSERT_NE(whole.find(from), whole.npos) << from;
    broken.replace(whole.find(from), std::string(from).size(), to);
    EXPECT_THAT(read_file(put(broken), 1 << 20), HasSubstr("It cannot be shown")) << to;
    EXPECT_TRUE(std::filesystem::exists(farm_.directory() / "index.html"));
  }
}

TEST_F(CostPage, SurvivesNumbersOfAnySize) {
  records::Cost record = cost_record();
  std::vector<records::CostVariant>& variants = record.tables[0].variants;
  variants.push_back(variant("huge", 1e300, 1e300));
  variants.push_back(variant("tiny", 1e-300, 1e-300));
  variants.push_back(variant("negative", -1, 0));
  variants.push_back(variant("endless", 1, std::numeric_limits<double>::infinity()));
  put(record);
  EXPECT_THAT(Site(farm_.directory()).bad_links(), IsEmpty());
  variants.clear();
  put(record);
  EXPECT_EQ(Site(farm_.directory()).page("cost.html").select_nodes("//g[@class='point']").size(),
            0u);
}

}  // namespace
}  // namespace lobelia::gallery
