// The views of one record each, from records that anybody may have written.
#include "gallery/pages/views.hpp"
#include "base/records/models.hpp"
#include "base/records/paper.hpp"
#include "base/records/stability.hpp"
#include "base/words/constants.hpp"
#include "gallery/site/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia::gallery {
namespace {

const std::string kHostileTitle = "<img src=x onerror=alert(1)>";

records::HighlightTables explorer_record() {
  const std::vector<std::vector<std::int64_t>> rows = {{0, -5, -10}, {0, -6, -12}, {0, -7, -14}};
  records::HighlightTables record;
  record.exponents = {1, 2, 4};
  record.per_octave = 1;
  record.most_grazing = 1.5706;
  record.error.curve = 2e-4;
  record.models = {{"modified_phong",
                    kHostileTitle,
                    "L and R",
                    true,
                    false,
                    "radiance",
                    "1/M0",
                    {},
                    1,
                    {1, 0, 0, 0}}};
  record.lobes = {
      {"cosine", "cosine", "(1 - s)^n", {}, 0, 0.1, {1.57, 1.57, 1.57}, {0.5, 0.4, 0.3}, rows}};
  record.highlights = {{"modified_phong",
                        "cosine",
                        {0.5, 0.6, 0.9},
                        {0.5, 0.6, 0.8},
                        0.01,
                        rows,
                        rows,
                        {0, 1},
                        {1}}};
  record.shader_parts = {kHostileTitle, "</script>"};
  return record;
}

records::StabilityOfCase case_of(const std::string& name, const std::string& meaning,
                                 double naive) {
  return {"lobe", name, meaning, 3, 0, 0, {naive, naive, 0}, {1e-8, 1, 0}, 0.5};
}

records::VerifyStability stability_record() {
  records::VerifyStability record;
  record.command = {"lobelia", "verify", "stability"};
  record.cases = 12;
  record.not_compared = 5;
  record.groups = {{"lobe", "The lobe " + kHostileTitle}};
  record.by_case = {case_of("angle 0", "hard because & why", kInfinity),
                    case_of(kHostileTitle, "", 0.5)};
  for (const double n : {1.0, 100.0, 1e4}) {
    const double naive = n > 10 ? kInfinity : 1e-7;
    record.by_exponent.push_back(
        {"lobe", "cosine", n, 3, 0, 0, {naive, naive, 0}, {1e-8, 1, 0}, 0.5});
  }
  record.curves = {{1e6,
                    "modified_phong",
                    "cosine",
                    {0, 0.1, 0.2},
                    {0.9, 0.4, 0.1},
                    {1.3, kInfinity, std::nan("")},
                    {0.9, 0.4, 0.1}}};
  const records::StabilityPicture picture{"a.exr", "./a-picture.png", "missing.png", 0.5};
  record.pictures = {{1000, picture, picture}};
  return record;
}

records::Claim claim(const std::string& name, const std::string& verdict) {
  return {name,
          "eq. (1)",
          "it is so, " + name,
          "1.7e-2",
          {{"largest", 0.017, "1.70e-2", "n = 16"}},
          "by a scan",
          verdict,
          "because " + kHostileTitle};
}

records::VerifyPaper paper_record() {
  records::VerifyPaper record;
  record.command = {"lobelia", "verify", "paper"};
  record.claims = {claim("one", "confirmed"), claim("two", "not reproduced"),
                   claim(kHostileTitle, "found")};
  record.figures = {{"bad id \"",
                     "A figure",
                     "what it shows",
                     {"n", 16, 1024, true, {16, 1e9}},
                     {"energy", -1, 1, {}, {}},
                     {},
                     {{"line", 99, {16, 64, 1024}, {0, std::nan(""), 0.5}}},
                     {"two"}}};
  return record;
}

struct ViewCase {
  const char *name, *file;
  std::string (*record)();
};
const ViewCase kViews[] = {
    {"explorer", "explorer/tables.json", [] { return record_text(explorer_record()); }},
    {"stability", "stability/stability.json", [] { return record_text(stability_record()); }},
    {"paper", "paper/paper.json", [] { return record_text(paper_record()); }}};

class RecordViews : public ::testing::TestWithParam<ViewCase> {
 protected:
  /// The text of the page, from a gallery of this record.
  std::string put(const std::string& record) {
    const auto path = farm_.directory() / GetParam().file;
    std::filesystem::create_directories(path.parent_path());
    write_file(path, record);
    if (std::string(GetParam().name) == "stability")
      write_file(path.parent_path() / "a-picture.png", tiny_png());
    write_gallery(farm_.directory());
    return read_file(farm_.directory() / page(), 1 << 20);
  }
  std::string page() const { return std::string(GetParam().name) + ".html"; }
  FakeFarm farm_;
};

TEST(PaperView, FindsTheClaimThatSurprisesMostIfItDoesNotHold) {
  FakeFarm farm;
  const auto index = [&](const std::string& verdict) {
    records::VerifyPaper record = paper_record();
    record.not_reproduced = 2;
    record.claims.push_back(claim("energy-cs16", verdict));
    record.claims.back().statement = "no energy is made";
    record.claims.back().reason = "some is";
    std::filesystem::create_directories(farm.directory() / "paper");
    write_file(farm.directory() / "paper/paper.json", record_text(record));
    write_gallery(farm.directory());
    return read_file(farm.directory() / "index.html", 1 << 20);
  };
  EXPECT_THAT(index("not reproduced"),
              ::testing::HasSubstr(
                  "2 could not be reproduced. It says that no energy is made, but some is."));
  EXPECT_THAT(index("confirmed"), ::testing::Not(::testing::HasSubstr("It says that")));
}

TEST_P(RecordViews, AreLinkedFromEveryPageAndWholeWithoutScript) {
  put(GetParam().record());
  const Site site(farm_.directory());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
  EXPECT_FALSE(site.page(page()).select_nodes("//main//svg | //main//table").empty());
  EXPECT_EQ(
      site.page("index.html").select_nodes(("//nav/a[@href='" + page() + "']").c_str()).size(), 1u);
  EXPECT_FALSE(site.page(page()).select_node("//img[@src='x']"));
}

TEST_P(RecordViews, AreNotThereWithoutTheirRecord) {
  write_gallery(farm_.directory());
  EXPECT_FALSE(std::filesystem::exists(farm_.directory() / page()));
}

TEST_P(RecordViews, ReportABrokenRecordInTheGallery) {
  // Every member in turn of another type, and gone.
  const Json whole = Json::parse(GetParam().record());
  put(GetParam().record());
  const std::filesystem::path path = farm_.directory() / GetParam().file;
  const View* const view = *std::ranges::find(views(), GetParam().name, &View::name);
  int said = 0;
  const auto walk = [&](auto&& self, const Json& at, const Json::json_pointer& place) -> void {
    for (const auto& [key, value] : at.items()) {
      const auto here = at.is_array() ? place / std::stoul(key) : place / key;
      for (const Json& other : {Json(-1e300), Json("text"), Json::array(), Json(nullptr)}) {
        Json broken = whole;
        broken[here] = other;
        write_json(path, broken);
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
TEST_P(StabilityView, ShowsMissingNumbersAsSuch) {
  const std::string text = put(GetParam().record());
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
  put(GetParam().record());
  const Site site(farm_.directory());
  const auto& page_of = site.page(page());
  EXPECT_EQ(page_of.select_nodes("//article").size(), 3u);
  const auto second = page_of.select_node("//article[@data-verdict='not reproduced']").node();
  EXPECT_THAT(text_of(second), HasSubstr("1.70 × 10⁻²"));
  EXPECT_EQ(second.select_nodes(".//a[@href='#plot-1-figure']").size(), 1u);
  EXPECT_EQ(page_of.select_nodes("//figure//a[@href='#claim-2']").size(), 1u);
}
INSTANTIATE_TEST_SUITE_P(One, PaperView, ::testing::Values(kViews[2]));

}  // namespace
}  // namespace lobelia::gallery
