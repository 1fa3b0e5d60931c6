// The views of one record each, from records that anybody may have written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "gallery/gallery.hpp"
#include "gallery/views.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"

namespace lobelia::gallery {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kHostileTitle = "<img src=x onerror=alert(1)>";

Json explorer_record() {
  Json record = make_record("highlight-tables");
  record["exponents"] = {1, 2, 4};
  record["perOctave"] = 1;
  record["mostGrazing"] = 1.5706;
  record["error"] = {{"curve", 2e-4}};
  record["models"] = Json::array({{{"name", "modified_phong"},
                                   {"title", kHostileTitle},
                                   {"angle", "L and R"},
                                   {"appliesCosine", true},
                                   {"normalised", "radiance"},
                                   {"coefficient", "1/M0"}}});
  const Json rows = Json::array({{0, -5, -10}, {0, -6, -12}, {0, -7, -14}});
  record["lobes"] = Json::array({{{"name", "cosine"},
                                  {"title", "cosine"},
                                  {"formula", "(1 - s)^n"},
                                  {"order", 0},
                                  {"unit", 0.1},
                                  {"reach", {1.57, 1.57, 1.57}},
                                  {"halfWidth", {0.5, 0.4, 0.3}},
                                  {"curves", rows}}});
  record["highlights"] = Json::array({{{"model", "modified_phong"},
                                       {"lobe", "cosine"},
                                       {"exact", {0.5, 0.6, 0.9}},
                                       {"paper", {0.5, 0.6, 0.8}},
                                       {"unit", 0.01},
                                       {"seen", rows},
                                       {"lit", rows}}});
  return record;
}

Json summary(const char* group, const char* key, const char* name, const Json& naive) {
  return {{"group", group},
          {key, name},
          {"cases", 3},
          {"outside", 0},
          {"naive", {{"ofPeak", naive}, {"ulp", naive}, {"wrongPixels", 0}}},
          {"ours", {{"ofPeak", 1e-8}, {"ulp", 1}, {"wrongPixels", 0}}},
          {"ofBound", 0.5}};
}

Json stability_record() {
  Json record = make_record("verify-stability");
  record["command"] = {"lobelia", "verify", "stability"};
  record["cases"] = 12;
  record["outside"] = 0;
  record["notCompared"] = 5;
  record["groups"] = Json::array({{{"name", "lobe"}, {"meaning", "The lobe " + kHostileTitle}}});
  record["byCase"] = Json::array({summary("lobe", "case", "angle 0", "inf"),
                                  summary("lobe", "case", kHostileTitle.c_str(), 0.5)});
  record["byCase"][0]["meaning"] = "hard because & why";
  record["byExponent"] = Json::array();
  for (const double n : {1.0, 100.0, 1e4}) {
    record["byExponent"].push_back(
        summary("lobe", "lobe", "cosine", n > 10 ? Json("inf") : Json(1e-7)));
    record["byExponent"].back()["exponent"] = n;
  }
  record["curves"] = Json::array({{{"exponent", 1e6},
                                   {"model", "modified_phong"},
                                   {"lobe", "cosine"},
                                   {"degrees", {0, 0.1, 0.2}},
                                   {"truth", {0.9, 0.4, 0.1}},
                                   {"naive", {1.3, "inf", "nan"}},
                                   {"ours", {0.9, 0.4, 0.1}}}});
  const Json picture = {
      {"png", "./a-picture.png"}, {"error", "missing.png"}, {"largestErrorOfPeak", 0.5}};
  record["pictures"] = Json::array({{{"exponent", 1000}, {"naive", picture}, {"ours", picture}}});
  return record;
}

Json paper_record() {
  Json record = make_record("verify-paper");
  record["command"] = {"lobelia", "verify", "paper"};
  const auto claim = [](const char* name, const char* verdict) {
    return Json{
        {"name", name},
        {"where", "eq. (1)"},
        {"statement", std::string("it is so, ") + name},
        {"printed", "1.7e-2"},
        {"measured",
         Json::array(
             {{{"what", "largest"}, {"value", 0.017}, {"text", "1.70e-2"}, {"at", "n = 16"}}})},
        {"definition", "by a scan"},
        {"verdict", verdict},
        {"reason", "because " + kHostileTitle}};
  };
  record["claims"] = Json::array({claim("one", "confirmed"), claim("two", "not reproduced"),
                                  claim(kHostileTitle.c_str(), "found")});
  record["figures"] = Json::array(
      {{{"id", "bad id \""},
        {"title", "A figure"},
        {"description", "what it shows"},
        {"x",
         {{"label", "n"}, {"from", 16}, {"to", 1024}, {"logarithmic", true}, {"ticks", {16, 1e9}}}},
        {"y", {{"label", "energy"}, {"from", -1}, {"to", 1}}},
        {"bands", Json::array()},
        {"series",
         Json::array(
             {{{"name", "line"}, {"style", 99}, {"x", {16, 64, 1024}}, {"y", {0, "nan", 0.5}}}})},
        {"claims", {"two"}}}});
  return record;
}

struct ViewCase {
  const char *name, *file;
  Json (*record)();
};
const ViewCase kViews[] = {{"explorer", "explorer/tables.json", explorer_record},
                           {"stability", "stability/stability.json", stability_record},
                           {"paper", "paper/paper.json", paper_record}};

class RecordViews : public ::testing::TestWithParam<ViewCase> {
 protected:
  /// The text of the page, from a gallery of this record.
  std::string put(const Json& record) {
    const auto path = farm_.directory() / GetParam().file;
    std::filesystem::create_directories(path.parent_path());
    write_record(path, record);
    if (std::string(GetParam().name) == "stability")
      write_file(path.parent_path() / "a-picture.png", tiny_png());
    write_gallery(farm_.directory());
    return read_file(farm_.directory() / page(), 1 << 20);
  }
  std::string page() const { return std::string(GetParam().name) + ".html"; }
  FakeFarm farm_;
};

TEST_P(RecordViews, AreLinkedFromEveryPageAndWholeWithoutScript) {
  put(GetParam().record());
  const Site site(farm_.directory());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
  EXPECT_FALSE(site.page(page()).select_nodes("//main//svg").empty());
  EXPECT_EQ(
      site.page("index.html").select_nodes(("//nav/a[@href='" + page() + "']").c_str()).size(), 1u);
  EXPECT_FALSE(site.page(page()).select_node("//img[@src='x']"));
}

TEST_P(RecordViews, AreNotThereWithoutTheirRecord) {
  write_gallery(farm_.directory());
  EXPECT_FALSE(std::filesystem::exists(farm_.directory() / page()));
}

TEST_P(RecordViews, OfABrokenRecordSaySoAndTheGalleryIsThere) {
  // Every member in turn of another type, and gone.
  const Json whole = GetParam().record();
  put(whole);
  const std::filesystem::path path = farm_.directory() / GetParam().file;
  const auto view = std::ranges::find(views(), GetParam().name, &View::name);
  int said = 0;
  const auto walk = [&](auto&& self, const Json& at, const Json::json_pointer& place) -> void {
    for (const auto& [key, value] : at.items()) {
      const auto here = at.is_array() ? place / std::stoul(key) : place / key;
      for (const Json& other : {Json(-1e300), Json("text"), Json::array(), Json(nullptr)}) {
        Json broken = whole;
        broken[here] = other;
        write_record(path, broken);
        const std::string text = "<main>" + view->draw(farm_.directory())->main.str() + "</main>";
        said += text.find("It cannot be shown") != text.npos;
        pugi::xml_document document;
        EXPECT_TRUE(document.load_string(text.c_str())) << here << " " << other;
      }
      if (value.is_structured() && here.to_string().size() < 24) self(self, value, here);
    }
  };
  walk(walk, whole, Json::json_pointer());
  EXPECT_GT(said, 20);
  write_gallery(farm_.directory());
  EXPECT_THAT(Site(farm_.directory()).bad_links(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(All, RecordViews, ::testing::ValuesIn(kViews),
                         [](const auto& one) { return std::string(one.param.name); });

class StabilityView : public RecordViews {};
TEST_P(StabilityView, ShowsNumbersMeaningsAndWhatIsNoNumber) {
  const std::string text = put(stability_record());
  EXPECT_THAT(text, HasSubstr("hard because &amp; why"));
  EXPECT_THAT(text, HasSubstr("no number"));
  EXPECT_THAT(text, HasSubstr("<strong>5</strong> not compared"));
  const Site site(farm_.directory());
  EXPECT_EQ(site.page(page()).select_nodes("//img[@src='stability/a-picture.png']").size(), 2u);
  EXPECT_THAT(text, HasSubstr("The picture missing.png is missing."));
}
INSTANTIATE_TEST_SUITE_P(One, StabilityView, ::testing::Values(kViews[1]));

class PaperView : public RecordViews {};
TEST_P(PaperView, TellsEachClaimWithItsNumberAndItsFigure) {
  put(paper_record());
  const Site site(farm_.directory());
  const auto& page_of = site.page(page());
  EXPECT_EQ(page_of.select_nodes("//article").size(), 3u);
  const auto second = page_of.select_node("//article[@data-verdict='not reproduced']").node();
  EXPECT_THAT(text_of(second), HasSubstr("1.70e-2"));
  EXPECT_EQ(second.select_nodes(".//a[@href='#plot-1-figure']").size(), 1u);
  EXPECT_EQ(page_of.select_nodes("//figure//a[@href='#claim-2']").size(), 1u);
}
INSTANTIATE_TEST_SUITE_P(One, PaperView, ::testing::Values(kViews[2]));

}  // namespace
}  // namespace lobelia::gallery
