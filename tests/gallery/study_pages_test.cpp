// The pages of cost, cheapest lobes and speed, from records that anybody may have written.
#include "base/records/bench.hpp"
#include "base/records/cost.hpp"
#include "base/records/lobe_search.hpp"
#include "gallery/site/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"
#include "tests/test.hpp"

namespace lobelia::gallery {
namespace {

class StudyPage : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    const auto path = farm_.directory() / file;
    std::filesystem::create_directories(path.parent_path());
    write_file(path, text);
  }
  /// The text of the page, from a gallery of the run with this record of the study.
  std::string put(const std::string& study, const std::string& record) const {
    write(study + "/" + study + ".json", record);
    write_gallery(farm_.directory());
    return read_file(farm_.directory() / (study + ".html"), 1 << 22);
  }
  const FakeFarm farm_;
};

// ---- what accuracy costs

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

class CostPage : public StudyPage {
 protected:
  std::string put(const records::Cost& record) const {
    write("cost/cost.csv", "x");
    return StudyPage::put("cost", record_text(record));
  }
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

TEST_F(CostPage, ExplainsTheFrontWithItsMeasurement) {
  const std::string text = put(cost_record());
  EXPECT_THAT(text, HasSubstr("from cs16 to cosine: 2.0 times the time"));
  EXPECT_THAT(text, HasSubstr("a remark &amp; more"));
  EXPECT_THAT(text, HasSubstr("lobelia cost &#39;a b.xml&#39;"));
  EXPECT_THAT(text, HasSubstr("&lt;img src=x onerror=alert(1)&gt;"));
  EXPECT_THAT(text, HasSubstr("1.00 ns"));
}

TEST_F(CostPage, ShowsCountsWithoutTimes) {
  records::Cost record = cost_record();
  record.tables[0].unit = "bit operations";
  for (records::CostVariant& one : record.tables[0].variants) {
    one.seconds.reset();
    one.count = 1408;
  }
  const std::string text = put(record);
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

TEST_F(CostPage, NamesTheFrontAloneInAChart) {
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
  EXPECT_EQ(page.select_nodes("//div[@class='narrow']//*[@class='point-name']").size(), 1u);
}

TEST_F(CostPage, HasNoChartForOnePoint) {
  records::Cost record = cost_record();
  std::vector<records::CostVariant>& variants = record.tables[0].variants;
  variants.resize(1);
  variants[0].seconds->rounds = 1;
  variants[0].seconds->spread = 0;
  record.tables[0].fronts = {{"max", {{"cs16"}, {}, {}, {}, "x.svg"}}};
  const std::string text = put(record);
  EXPECT_EQ(Site(farm_.directory()).page("cost.html").select_nodes("//svg").size(), 0u);
  EXPECT_THAT(text, HasSubstr("Only “cs16” was measured"));
  EXPECT_THAT(text, HasSubstr("<td class=\"number\">one run</td>"));
  EXPECT_THAT(text, Not(HasSubstr("± 0 %")));
}

TEST_F(CostPage, PublishesNoDrawingOfTheRun) {
  records::Cost record = cost_record();
  record.tables[0].variants[1].errors = {{"max", 0}};
  record.command = {"lobelia", "cost", "/srv/someone/scene.xml"};
  // A browser that opens it would run its scripts.
  write("cost/lobe-n64-max.svg", "<svg><script>1</script></svg>");
  const std::string text = put(record);
  EXPECT_THAT(text,
              HasSubstr("The fastest is “cs16”, with 1.00 ns and an error of 0.017. The least "
                        "error has “cosine”, with 2.00 ns and no error: 2 times the time."));
  EXPECT_THAT(text, HasSubstr("<th scope=\"col\">largest error of the lobe</th>"));
  EXPECT_THAT(text, HasSubstr(">0</text>")) << "the error of 0 has a place on the axis";
  EXPECT_THAT(text, Not(HasSubstr("/srv/someone")));
  EXPECT_THAT(text, Not(HasSubstr(".svg\"")));
  EXPECT_THAT(Site(farm_.directory()).bad_links(), IsEmpty());
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

// ---- the cheapest lobes

records::SearchedLobe searched(const std::string& name, int price, double error) {
  records::SearchedLobe lobe;
  lobe.name = name;
  lobe.formula = "1 - t < 2";
  lobe.price = price;
  lobe.bound = lobe.errors.max = error;
  lobe.seconds = {2e-10, 0.05};
  lobe.by_exponents = {{16, error}, {32, error / 2}};
  return lobe;
}

records::LobeSearch search_record() {
  records::LobeSearch found;
  found.command = {"lobelia", "search"};
  found.least_exponent = 16;
  found.family = "all";
  found.metric = "max";
  found.precision = "float32";
  found.coefficients = "by-n";
  found.lobes = {searched("pk3.1", 5, 3.5e-3), searched("cs16", 6, 1.8e-2),
                 searched("pk1.4", 6, 1.7e-2), searched("pk3.2", 6, 4.8e-4),
                 searched("schlick", 8, 0.2)};
  return found;
}

class SearchPage : public StudyPage {
 protected:
  std::string put(const records::LobeSearch& record) const {
    return StudyPage::put("search", record_text(record));
  }
};

TEST_F(SearchPage, ShowsItsFirstChartWithoutAScript) {
  write("search/pk3.2.glsl", "float lobe;");
  put(search_record());
  const Site site(farm_.directory());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
  const auto& page = site.page("search.html");
  EXPECT_EQ(page.select_nodes("//figure").size(), 3u);
  EXPECT_EQ(page.select_nodes("//figure[not(@hidden)]").size(), 1u);
  EXPECT_EQ(page.select_nodes("//figure[1]/div[@class='wide']//g[@class='point']").size(), 5u);
  EXPECT_EQ(page.select_nodes("//tbody/tr").size(), 5u);
  EXPECT_EQ(page.select_nodes("//a[@href='search/pk3.2.glsl']").size(), 1u);
  EXPECT_EQ(page.select_nodes("//a[contains(@href, '.glsl')]").size(), 1u);
}

TEST_F(SearchPage, IsSafeWhateverTheRecordSays) {
  records::LobeSearch record = search_record();
  record.lobes[0].name = "../../x";
  record.lobes[1].formula = "<img src=x onerror=alert(1)>";
  record.lobes[2].by_exponents.clear();
  record.lobes[3].errors.max = 1e300;
  record.lobes[4].price = 0;
  const std::string text = put(record);
  EXPECT_THAT(text, HasSubstr("&lt;img src=x onerror=alert(1)&gt;"));
  EXPECT_THAT(Site(farm_.directory()).active_content(), IsEmpty());
  EXPECT_THAT(Site(farm_.directory()).bad_links(), IsEmpty());
  record.lobes.clear();
  EXPECT_THAT(put(record), HasSubstr("No lobe was found"));
}

// ---- speed

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

class BenchPage : public StudyPage {
 protected:
  std::string put(const records::Bench& record) const {
    return StudyPage::put("bench", record_text(record));
  }
};

TEST_F(BenchPage, ShowsTheLastRunWithTheHistoryOfEachGoal) {
  records::Bench record{{run_of("abc1", 84), run_of("abc2", 96), run_of("abc3", 112)}};
  record.runs[0].goals.pop_back();
  const std::string text = put(record);
  const Site site(farm_.directory());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
  const auto& page = site.page("bench.html");
  EXPECT_EQ(page.select_nodes("//tbody/tr").size(), 2u);
  ASSERT_EQ(page.select_nodes("//figure").size(), 2u);
  EXPECT_EQ(page.select_nodes("//figure[1]//g[@class='point']").size(), 3u);
  EXPECT_EQ(page.select_nodes("//figure[2]//g[@class='point']").size(), 2u);
  EXPECT_THAT(text, HasSubstr("2 of 2 goals of speed are met by abc3 of 2026-01-31."));
  EXPECT_THAT(text, HasSubstr("compare.flip was not measured: no flip here."));
  EXPECT_THAT(text, HasSubstr("abc1 of 2026-01-31: 84"));
}

TEST_F(BenchPage, DrawsNoChartOfOnePoint) {
  const std::string text = put({{run_of("abc1", 84)}});
  EXPECT_EQ(Site(farm_.directory()).page("bench.html").select_nodes("//svg").size(), 0u);
  EXPECT_THAT(text, HasSubstr("There is one run so far."));
  EXPECT_THAT(text, HasSubstr("1 of 2 goals of speed are met"));
}

TEST_F(BenchPage, IsSafeWhateverTheRecordSays) {
  records::Bench record{{run_of("<img src=x>", 1e300), run_of("b", 0)}};
  record.runs[1].goals[0].what = "<script>alert(1)</script>";
  record.runs[1].goals[1].unit = "\"><b>";
  record.runs[1].left_out = {{"a", "<i>"}};
  const std::string text = put(record);
  EXPECT_THAT(Site(farm_.directory()).active_content(), IsEmpty());
  EXPECT_THAT(text, Not(HasSubstr("<script>alert(1)")));
  EXPECT_THAT(text, Not(HasSubstr("<img src=x>")));
  EXPECT_THAT(put({}), HasSubstr("Nothing was measured."));
}

}  // namespace
}  // namespace lobelia::gallery
