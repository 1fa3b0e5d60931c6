#include "base/records/catalogue.hpp"
#include "base/system/error.hpp"
#include "gallery/cells/cell_page.hpp"
#include "gallery/pages/grid_layout.hpp"
#include "gallery/pages/page.hpp"
#include "gallery/pages/page_text.hpp"
#include "gallery/site/gallery.hpp"
#include "lobelia_paths.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia::gallery {
namespace {

TEST(GalleryPages, HaveAPageForEveryCellAndNoDeadLink) {
  const FakeFarm farm;
  EXPECT_EQ(write_gallery(farm.directory()).index, farm.directory() / "index.html");
  const Site site(farm.directory());
  EXPECT_EQ(site.pages().size(), 5u);
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_EQ(site.page("index.html").select_nodes("//li[@data-status]").size(), 4u);
  EXPECT_EQ(site.page("index.html").select_nodes("//li[@data-status]//img").size(), 3u);
  for (const std::string& id :
       {FakeFarm::kPass, FakeFarm::kDiffers, FakeFarm::kFailed, FakeFarm::kMissing}) {
    EXPECT_EQ(site.cell(id).select_nodes("//h1").size(), 1u) << id;
  }
}

TEST(GalleryPages, TakeNothingFromANetwork) {
  const FakeFarm farm;
  write_gallery(farm.directory());
  for (auto [name, text] : files_below(farm.directory())) {
    if (name.ends_with(".json")) continue;
    // A namespace is a name, not an address.
    for (std::size_t at; (at = text.find("http://www.w3.org/2000/svg")) != text.npos;)
      text.erase(at, 26);
    EXPECT_THAT(text, Not(HasSubstr("http:"))) << name;
    EXPECT_THAT(text, Not(HasSubstr("https:"))) << name;
    EXPECT_THAT(text, Not(HasSubstr("@import"))) << name;
  }
  EXPECT_THAT(Site(farm.directory()).active_content(), IsEmpty());
}

TEST(GalleryPages, AreTheSameAnywhereForTheSameRecords) {
  const FakeFarm one, other;
  write_gallery(one.directory());
  write_gallery(other.directory());
  const auto first = files_below(one.directory());
  EXPECT_EQ(first, files_below(other.directory()));
  write_gallery(one.directory());
  EXPECT_EQ(first, files_below(one.directory()));
  for (const auto& [name, text] : first) {
    EXPECT_THAT(text, Not(HasSubstr(one.directory().string()))) << name;
  }
}

TEST(GalleryPages, NameAMissingEngineAndHowToGetIt) {
  const FakeFarm farm;
  write_gallery(farm.directory());
  const Site site(farm.directory());
  for (const std::string& name :
       {std::string("index.html"), "cells/" + FakeFarm::kPass + "/index.html"}) {
    const std::string text = text_of(site.page(name));
    EXPECT_THAT(text, HasSubstr("Blender Cycles")) << name;
    EXPECT_THAT(text, HasSubstr("no program 'blender' in $PATH")) << name;
    EXPECT_THAT(text, HasSubstr("sudo apt-get install blender")) << name;
  }
}

TEST(GalleryPages, ShowNumbersCurvesPlanAndCommandsOfACell) {
  const FakeFarm farm;
  write_gallery(farm.directory());
  const Site site(farm.directory());
  const auto& page = site.cell(FakeFarm::kPass);
  EXPECT_EQ(page.select_nodes("//svg").size(), 1u);
  const std::string text = text_of(page);
  for (const char* words :
       {"Phong (RDF) · n = 16", "white = 0.0016 = 0.06 % of the peak", "some.new.one", "at (1, 0)",
        "✓ within 3", "one convex body", "lobelia render 'scene with space.xml'",
        "povray +Iscene.pov", "−1.5 stops", "epicentre", "flank 10° to 20°", "n as a cosine lobe",
        "16.25", "camera 4"}) {
    EXPECT_THAT(text, HasSubstr(words));
  }
}

TEST(GalleryPages, NameMissingPartsInWords) {
  const FakeFarm farm;
  std::ofstream(farm.cell_directory(FakeFarm::kPass) / "lobelia.png") << "no picture";
  write_file(farm.cell_directory(FakeFarm::kDiffers) / "lobelia-povray.json", "{ broken");
  write_gallery(farm.directory());
  const Site site(farm.directory());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  const std::string pass = text_of(site.cell(FakeFarm::kPass));
  EXPECT_THAT(pass, HasSubstr("The picture lobelia.png is not a complete PNG."));
  const std::string differs = text_of(site.cell(FakeFarm::kDiffers));
  EXPECT_THAT(differs, HasSubstr("lobelia-povray.json is not JSON."));
  EXPECT_THAT(text_of(site.cell(FakeFarm::kFailed)),
              HasSubstr("POV-Ray made no picture: stopped after 600 s"));
  EXPECT_THAT(text_of(site.cell(FakeFarm::kMissing)), HasSubstr("lobelia farm small.xml -o out"));
}

TEST(GalleryPages, ListCellsThatNeedALookWithTheirReason) {
  const FakeFarm farm;
  GalleryOptions options;
  options.metrics = some_metrics();
  write_gallery(farm.directory(), options);
  const Site site(farm.directory());
  const std::string list =
      text_of(site.page("index.html").select_node("//section[@class='attention']").node());
  EXPECT_THAT(list, HasSubstr("POV-Ray: stopped after 600 s"));
  EXPECT_THAT(list, HasSubstr("Pixels beyond the tolerance: 9, limit 3"));
  EXPECT_THAT(list, Not(HasSubstr("n = 16 · ")));
}

TEST(GalleryPages, NeedAFarm) {
  const TemporaryDirectory empty;
  EXPECT_THAT(error_words(ExitCode::kInput, [&] { write_gallery(empty.path()); }),
              AllOf(HasSubstr("farm.json: no such file"), HasSubstr("lobelia farm")));
  EXPECT_TRUE(std::filesystem::is_empty(empty.path()));
}

TEST(GalleryPages, AreUnchangedASecondTime) {
  const FakeFarm farm;
  const TemporaryDirectory scratch;
  GalleryOptions options;
  options.site = scratch.path() / "site";
  EXPECT_EQ(write_gallery(farm.directory(), options).index, scratch.path() / "site/index.html");
  EXPECT_FALSE(std::filesystem::exists(farm.directory() / "index.html"));
  EXPECT_THAT(Site(options.site).bad_links(), IsEmpty());
  const auto times = [&] {
    std::map<std::string, std::filesystem::file_time_type> result;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(options.site))
      if (entry.is_regular_file()) result[entry.path().string()] = entry.last_write_time();
    return result;
  };
  const auto before = times();
  EXPECT_GT(before.size(), 30u);
  write_gallery(farm.directory(), options);
  EXPECT_EQ(times(), before);
}

TEST(GalleryPages, KeepNothingOfAGoneCellButFilesOfOthers) {
  FakeFarm farm;
  const TemporaryDirectory scratch, elsewhere;
  GalleryOptions options;
  options.site = scratch.path();
  write_gallery(farm.directory(), options);
  write_file(scratch.path() / "cells" / FakeFarm::kDiffers / "mine.txt", std::string_view("mine"));
  // A list that somebody has changed must not lead out of the site.
  const std::filesystem::path outside = elsewhere.path() / "index.html";
  write_file(outside, std::string_view("elsewhere"));
  std::filesystem::create_directory_symlink(elsewhere.path(), scratch.path() / "link");
  Json list = read_json(scratch.path() / "gallery.json");
  for (const auto& name : {outside.lexically_relative(scratch.path()).string(), outside.string(),
                           std::string("link/index.html")})
    list["files"].push_back(name);
  write_json(scratch.path() / "gallery.json", list);
  farm.leave_out({FakeFarm::kDiffers, FakeFarm::kFailed});
  write_gallery(farm.directory(), options);
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "cells" / FakeFarm::kFailed));
  const auto left = files_below(scratch.path() / "cells" / FakeFarm::kDiffers);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left.begin()->first, "mine.txt");
  EXPECT_TRUE(std::filesystem::exists(outside));
  EXPECT_THAT(Site(scratch.path()).bad_links(), IsEmpty());
}

TEST(GalleryPages, HaveTheScriptAndStyleThatWereBuilt) {
  const FakeFarm farm;
  write_gallery(farm.directory());
  for (const char* file : {"gallery.js", "gallery.css"}) {
    const std::filesystem::path built =
        std::filesystem::path(LOBELIA_SOURCE_DIR) / "gallery/web/dist" / file;
    EXPECT_EQ(read_file(farm.directory() / file, 1 << 20), read_file(built, 1 << 20)) << file;
  }
}

TEST(GalleryPages, HaveAScriptCompiledWithTheTypesOfTheTables) {
  const auto types = std::filesystem::path(LOBELIA_SOURCE_DIR) / "gallery/web/src/records.ts";
  EXPECT_EQ(read_file(types, 1 << 20), records::typescript_text())
      << "lobelia records --typescript > gallery/web/src/records.ts, and build the script anew";
}

class PackedGallery : public ::testing::Test {
 protected:
  PackedGallery() {
    options_.site = elsewhere_.path() / "site";
    options_.metrics_only = true;
  }
  void publish(std::optional<bool> packed) {
    options_.packed = packed;
    write_gallery(farm_.directory(), options_);
  }

  FakeFarm farm_;
  TemporaryDirectory elsewhere_;
  GalleryOptions options_;
};

TEST_F(PackedGallery, AddsNoFileForACell) {
  publish(true);
  const std::size_t before = files_below(options_.site).size();
  farm_.add_cell("one_more", "pass", {});
  farm_.write();
  publish(true);
  EXPECT_EQ(files_below(options_.site).size(), before);
}

TEST_F(PackedGallery, LeavesNothingOfTheOtherLayout) {
  const auto names_with = [&](bool packed) {
    publish(packed);
    std::set<std::string> names;
    for (const auto& [name, text] : files_below(options_.site)) names.insert(name);
    return names;
  };
  const auto single = names_with(false), packed = names_with(true);
  EXPECT_TRUE(single.contains("cells/" + FakeFarm::kPass + "/index.html"));
  EXPECT_FALSE(fs::exists(options_.site / "cells"));
  EXPECT_TRUE(packed.contains("cell.html"));
  EXPECT_EQ(names_with(false), single);
  EXPECT_FALSE(fs::exists(options_.site / "packed"));
  EXPECT_EQ(names_with(true), packed);
}

TEST_F(PackedGallery, IsForManyCells) {
  publish(std::nullopt);
  EXPECT_FALSE(fs::exists(options_.site / "cell.html"));
}

TEST_F(PackedGallery, HasNoLinkThatLeadsNowhere) {
  publish(true);
  const Site site(options_.site);
  EXPECT_EQ(site.pages().size(), 2u);
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
}

TEST_F(PackedGallery, IsMadeWithoutAPictureThatCannotBeDecoded) {
  std::string damaged = tiny_png();
  damaged.replace(damaged.size() - 30, 8, 8, '\0');
  write_file(farm_.cell_directory(FakeFarm::kPass) / "lobelia.png", damaged);
  farm_.seal(FakeFarm::kPass);
  for (const bool packed : {true, false}) EXPECT_NO_THROW(publish(packed)) << packed;
}

ShownFarm farm_of(const std::vector<int>& sizes) {
  ShownFarm farm;
  for (const int size : sizes) {
    records::Axis axis{"axis" + std::to_string(farm.record.axes.size()), {}};
    for (int i = 0; i < size; ++i) axis.values.push_back({std::to_string(i), std::to_string(i)});
    farm.record.axes.push_back(std::move(axis));
  }
  return farm;
}

TEST(GridLayout, MakesRowsColumnGroupsColumnsAndSectionsOfFourAxes) {
  const ShownFarm farm = farm_of({6, 3, 4, 2});
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.rows, 0);
  EXPECT_EQ(layout.groups, 1);
  EXPECT_EQ(layout.columns, 2);
}

TEST(GridLayout, MakesSectionsOfLightsWhereverTheGridNamesThem) {
  ShownFarm farm = farm_of({2, 6, 3, 3});
  farm.record.axes[0].name = "light";
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.rows, 1);
  EXPECT_EQ(layout.groups, 2);
  EXPECT_EQ(layout.columns, 3);
}

TEST(GridLayout, GroupsNoColumnsThatWouldBeTooMany) {
  const ShownFarm farm = farm_of({2, 6, 3});
  const GridLayout layout = lay_out(farm);
  EXPECT_EQ(layout.groups, -1);
  EXPECT_EQ(layout.columns, 2);
}

// Texts of records as pages show them.

TEST(PageText, SetsFormulasAsTheyArePrinted) {
  const std::pair<const char*, const char*> cases[] = {
      {"cos^n exceeds cs16 by 1.7e-2 at most", "cosⁿ exceeds cs16 by 1.7 × 10⁻² at most"},
      {"theta_cr is nearly 6/sqrt(n)", "θ_cr is nearly 6/√n"},
      {"2 arcsin(sqrt(8/n))", "2 arcsin(√(8/n))"},
      {"8e+08 times, below 1e-15, 1e-02", "8 × 10⁸ times, below 10⁻¹⁵, 10⁻²"},
      {"-9.7e-3", "−9.7 × 10⁻³"},
      {"max(0, 1 - n s / 16)^16", "max(0, 1 − n s / 16)¹⁶"},
      {"n >= 16, n = 16..1024, 48 x 48", "n ≥ 16, n = 16 to 1024, 48 × 48"},
      {"start 0.00 ns, parse 286 us", "start 0, parse 286 µs"},
      {"takes 2764247337825939 s", "takes 2.76 × 10¹⁵ s"},
      {"4 pi where N.L = 1", "4 π where N·L = 1"},
      {"a-b.c, e-mail, -q x, 1.5, v2.0e", "a-b.c, e-mail, -q x, 1.5, v2.0e"}};
  for (const auto& [record, page] : cases) EXPECT_EQ(math_text(record), page);
}

TEST(PageText, RaisesExponentsByMarkup) {
  Html html;
  write_math(html, "2^(-n/2) < theta_cr");
  EXPECT_EQ(html.str(), "2<sup>−n/2</sup> &lt; θ<sub>cr</sub>");
}

TEST(PageText, EndsWhateverIsNested) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "sqrt(2^(";
  EXPECT_GE(math_text(deep).size(), 1u);
  EXPECT_GE(math_text(std::string(5000, '9') + " s").size(), 1u);
}

TEST(DataScript, IsOneTextOfJavaScriptWhateverTheDataHold) {
  EXPECT_EQ(data_script("a", R"({"x":"it's \n"})"), R"(lobelia('a','{"x":"it\'s \\n"}');)"
                                                    "\n");
}

// The words of a cell's page and of the index.

CheckedComparison compared(double worst) {
  CheckedComparison comparison;
  comparison.record.metrics = {
      {"max_rel_peak", worst}, {"max_abs.x", 156.0}, {"max_abs.y", 99.0}, {"outliers", 0.0}};
  comparison.record.tolerance = records::Tolerance{};
  comparison.record.tolerance->relative = 0x1p-11;
  comparison.record.tolerance->of_peak = 1e-5;
  comparison.record.tolerance->allowed_outliers = 3;
  comparison.verdict = "pass";
  return comparison;
}

TEST(Story, NamesTheLargestDifferenceWithItsPlace) {
  EXPECT_EQ(story_of(compared(0.00041), "POV-Ray"),
            "Largest difference 0.041 % of the peak at (156, 99): POV-Ray writes half floats, "
            "whose rounding is 0.049 % of the value; 0.001 % of the peak is allowed for "
            "arithmetic.");
}

TEST(Story, BlamesHalfFloatsOnlyWhereTheToleranceIsTheirs) {
  CheckedComparison comparison = compared(0.00041);
  for (const double relative : {0.0, 0x1p-24, 0x1p-10}) {
    comparison.record.tolerance->relative = relative;
    EXPECT_THAT(story_of(comparison, "POV-Ray"), Not(HasSubstr("half floats"))) << relative;
  }
}

TEST(Story, TellsEdgesFromPixelsWithoutAKnownCause) {
  CheckedComparison comparison = compared(0.3);
  records::Named<double>& metrics = comparison.record.metrics;
  std::erase_if(metrics, [](const auto& metric) { return metric.first == "outliers"; });
  metrics.emplace_back("outliers", 2.0);
  metrics.emplace_back("outliers.off_edge", 0.0);
  EXPECT_THAT(story_of(comparison, "POV-Ray"),
              HasSubstr("2 pixels are beyond that, on edges alone"));
  metrics.back().second = 1;
  EXPECT_THAT(story_of(comparison, "POV-Ray"), HasSubstr("The record does not say why."));
}

TEST(Story, OmitsUntrustedFigures) {
  CheckedComparison comparison = compared(0.00041);
  comparison.doubt = CellStatus::kDamaged;
  EXPECT_EQ(story_of(comparison, "POV-Ray"), "");
  comparison.doubt.reset();
  comparison.record.nonfinite.b = 7;
  EXPECT_THAT(story_of(comparison, "POV-Ray"), HasSubstr("7 values are NaN or infinite"));
}

TEST(FirstScreen, LinksTheFarthestCell) {
  const FakeFarm farm;
  farm.change<records::Comparison>(FakeFarm::kDiffers, "lobelia-povray.json",
                                   [](records::Comparison& comparison) {
                                     for (auto& [metric, value] : comparison.metrics)
                                       if (metric == "max_rel_peak") value = 0.02;
                                   });
  GalleryOptions options;
  options.metrics = some_metrics();
  write_gallery(farm.directory(), options);
  const Site site(farm.directory());
  const auto& index = site.page("index.html");
  EXPECT_THAT(index.select_node("//p[@class='lead']").node().text().get(),
              HasSubstr("1 of 4 highlights agree with POV-Ray; 1 differs."));
  EXPECT_EQ(
      std::string(index.select_node("//section[@class='findings']//a/@href").attribute().value()),
      "cells/" + FakeFarm::kDiffers + "/index.html");
  EXPECT_EQ(index.select_nodes("//div[@class='pair']//img").size(), 2u);
  EXPECT_THAT(index.select_node("//section[@class='findings']//li").node().text().get(),
              HasSubstr("Farthest beyond its limit"));
}

TEST(FirstScreen, CountsCellsByVerdict) {
  for (const auto& [pass, differ, sentence] :
       {std::tuple(1, 0, "All 1 highlights agree with POV-Ray, "),
        {3, 0, "All 3 highlights agree with POV-Ray, "},
        {2, 2, "2 of 4 highlights agree with POV-Ray; 2 differ."},
        {0, 1, "0 of 1 highlights agree with POV-Ray; 1 differs."}}) {
    FakeFarm farm;
    farm.leave_out({FakeFarm::kPass, FakeFarm::kDiffers, FakeFarm::kFailed, FakeFarm::kMissing});
    for (int i = 0; i < pass + differ; ++i)
      farm.add_cell("cell" + std::to_string(i), i < pass ? "pass" : "differs",
                    {{"model", "phong_rdf"}, {"exponent", std::to_string(16 + i)}});
    write_gallery(farm.directory());
    EXPECT_THAT(Site(farm.directory())
                    .page("index.html")
                    .select_node("//p[@class='lead']")
                    .node()
                    .text()
                    .get(),
                HasSubstr(sentence));
  }
}

TEST(FirstScreen, CitesTheStudyWhereItsGridNamesTheAuthors) {
  FakeFarm farm;
  write_gallery(farm.directory());
  const char* citation = "//section[@class='citation']//code";
  EXPECT_TRUE(Site(farm.directory()).page("index.html").select_nodes(citation).empty());
  farm.farm().authors = "A. Author and {B} & C_D";
  farm.farm().url = "https://example.org/a_b";
  farm.write();
  write_gallery(farm.directory());
  const Site site(farm.directory());
  const std::string entry = site.page("index.html").select_node(citation).node().text().get();
  EXPECT_THAT(entry, HasSubstr("author = {A. Author and B \\& C\\_D},"));
  EXPECT_THAT(entry, HasSubstr("url = {https://example.org/a_b},"));
}

}  // namespace
}  // namespace lobelia::gallery
