#include "base/records/catalogue.hpp"
#include "base/system/error.hpp"
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

}  // namespace
}  // namespace lobelia::gallery
