// Changes since an earlier run: the rule, and the pages.
#include "gallery/cells/change.hpp"

#include "base/pictures/image_io.hpp"
#include "base/records/comparison.hpp"
#include "base/records/render.hpp"
#include "base/system/error.hpp"
#include "gallery/cells/history.hpp"
#include "gallery/site/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia::gallery {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Reading reading(double value, std::optional<double> limit = {}) { return {value, {}, limit, 0}; }
Reading noisy(double value, double low, double high) {
  records::ErrorBar bar;
  bar.low = low;
  bar.high = high;
  return {value, bar, {}, 0};
}

TEST(ChangeRule, CallsOverOnePerCentOfTheValueAChange) {
  EXPECT_EQ(change_of(reading(1), reading(1.009), false), Change::kSame);
  EXPECT_EQ(change_of(reading(1), reading(1.02), false), Change::kWorse);
  EXPECT_EQ(change_of(reading(1.02), reading(1), false), Change::kBetter);
  EXPECT_EQ(change_of(reading(0), reading(1e-300), false), Change::kWorse);
}

TEST(ChangeRule, CallsUnderOnePerCentOfTheLimitNone) {
  EXPECT_EQ(change_of(reading(0.001), reading(0.01, 1), false), Change::kSame);
  EXPECT_EQ(change_of(reading(0.001), reading(0.02, 1), false), Change::kWorse);
}

TEST(ChangeRule, CallsTheRoundingOfFloat32None) {
  Reading was = reading(1e-8), now = reading(1e-7);
  EXPECT_EQ(change_of(was, now, false), Change::kWorse);
  now.rounding = 0x1p-23;
  EXPECT_EQ(change_of(was, now, false), Change::kSame);
}

TEST(ChangeRule, CallsOverlappingErrorBarsNone) {
  EXPECT_EQ(change_of(noisy(1, 0.8, 1.2), noisy(1.3, 1.1, 1.5), false), Change::kSame);
  EXPECT_EQ(change_of(noisy(1, 0.8, 1.05), noisy(1.3, 1.1, 1.5), false), Change::kWorse);
  EXPECT_EQ(change_of(reading(1.4), noisy(1.2, 1.1, 1.5), false), Change::kSame);
  EXPECT_EQ(change_of(noisy(1, kNan, kNan), reading(9), false), Change::kSame);
}

TEST(ChangeRule, CountsTheSignOfAnErrorAndTheDirectionOfALikeness) {
  EXPECT_EQ(change_of(reading(-1), reading(1), false), Change::kSame);
  EXPECT_EQ(change_of(reading(1), reading(-2), false), Change::kWorse);
  EXPECT_EQ(change_of(reading(40), reading(30), true), Change::kWorse);
  // Near 1 the distance from 1 is what counts.
  EXPECT_EQ(change_of(reading(0.9999), reading(0.999), true), Change::kWorse);
  EXPECT_EQ(change_of(reading(0.999), reading(0.9999), true), Change::kBetter);
}

TEST(ChangeRule, GivesNumbersThatAreNotFiniteADirection) {
  EXPECT_EQ(change_of(reading(kNan), reading(kNan), false), Change::kSame);
  EXPECT_EQ(change_of(reading(1), reading(kNan), false), Change::kWorse);
  EXPECT_EQ(change_of(reading(kNan), reading(1), false), Change::kBetter);
  EXPECT_EQ(change_of(reading(1), reading(INFINITY), false), Change::kWorse);
  EXPECT_EQ(change_of(reading(INFINITY), reading(1), false), Change::kBetter);
  EXPECT_EQ(change_of(reading(INFINITY), reading(-INFINITY), false), Change::kSame);
}

TEST(MatchCells, GoesByTheValuesOnAllAxesInAnyOrder) {
  records::Farm now, earlier;
  now.cells = {{"a-1", "pass", {{"model", "a"}, {"n", "1"}}},
               {"a-2", "pass", {{"model", "a"}, {"n", "2"}}}};
  earlier.cells = {{"2-a", "pass", {{"n", "2"}, {"model", "a"}}},
                   {"a-1", "pass", {{"model", "b"}, {"n", "1"}}}};
  EXPECT_THAT(match_cells(now, earlier), ElementsAre(std::nullopt, std::optional<std::size_t>(0)));
}

TEST(MatchCells, GoesByTheLastPartOfAPathWhereThatIsNeeded) {
  records::Farm now, earlier;
  now.cells = {{"x", "pass", {{"light", "../scenes/side.xml"}}}};
  earlier.cells = {{"y", "pass", {{"light", "old/side.xml"}}}};
  EXPECT_THAT(match_cells(now, earlier), ElementsAre(std::optional<std::size_t>(0)));
  earlier.cells.push_back({"z", "pass", {{"light", "other/side.xml"}}});
  EXPECT_THAT(match_cells(now, earlier), ElementsAre(std::nullopt)) << "two could be meant";
  earlier.cells.push_back({"z", "pass", {{"light", "../scenes/side.xml"}}});
  EXPECT_THAT(match_cells(now, earlier), ElementsAre(std::optional<std::size_t>(2)));
}

TEST(MatchCells, GoesByTheIdsOfEqualPlaces) {
  records::Farm now, earlier;
  now.cells = {{"p", "pass", {{"n", "1"}}}, {"q", "pass", {{"n", "1"}}}};
  earlier.cells = {{"q", "pass", {{"n", "1"}}}, {"p", "pass", {{"n", "1"}}}};
  EXPECT_THAT(match_cells(now, earlier),
              ElementsAre(std::optional<std::size_t>(1), std::optional<std::size_t>(0)));
}

/// Two farms, and the site of the new one.
class Changes : public testing::Test {
 protected:
  PublishedGallery publish(std::vector<fs::path> baselines) {
    GalleryOptions options;
    options.site = site_.path();
    options.metrics = some_metrics();
    options.baselines = std::move(baselines);
    return write_gallery(now_.directory(), options);
  }
  PublishedGallery publish() { return publish({was_.directory()}); }
  std::string index() const { return text_of(Site(site_.path()).page("index.html")); }
  std::string sentence() const {
    const Site site(site_.path());
    return text_of(site.page("index.html").select_node("//p[@class='since']").node());
  }
  std::string cell(const std::string& id) const { return text_of(Site(site_.path()).cell(id)); }
  static void set_worst(const FakeFarm& farm, const std::string& id, double value) {
    farm.change<records::Comparison>(id, "lobelia-povray.json", [&](records::Comparison& record) {
      for (auto& [name, number] : record.metrics)
        if (name == "max_rel_peak") number = value;
    });
  }
  static void set_noise(const FakeFarm& farm, double low, double high) {
    farm.change<records::Comparison>(
        FakeFarm::kPass, "lobelia-povray.json", [&](records::Comparison& record) {
          records::ErrorBar bar;
          bar.low = low;
          bar.high = high;
          record.error_bars.emplace().emplace_back("max_rel_peak", bar);
        });
  }

  FakeFarm was_, now_;
  TemporaryDirectory site_;
};

TEST_F(Changes, AreNoneForTheSameRunTwice) {
  EXPECT_THAT(publish().worse, IsEmpty());
  EXPECT_THAT(sentence(), HasSubstr(": 4 cells are as before."));
  EXPECT_THAT(cell(FakeFarm::kPass), HasSubstr("As on "));
  const Site site(site_.path());
  EXPECT_THAT(site.bad_links(), IsEmpty());
  EXPECT_THAT(site.active_content(), IsEmpty());
}

TEST_F(Changes, CallALostPassWorseAndTheReverseBetter) {
  // The two differ in which cell differs.
  now_.change<records::Comparison>(FakeFarm::kPass, "lobelia-povray.json", [](auto& record) {
    record.limits[0].limit = 0;
    record.limits[0].pass = false;
    record.verdict = "differs";
  });
  now_.change<records::Comparison>(FakeFarm::kDiffers, "lobelia-povray.json", [](auto& record) {
    record.limits[0].limit = 99;
    record.limits[0].pass = true;
    record.verdict = "pass";
  });
  now_.change<records::Cell>(FakeFarm::kPass, "cell.json",
                             [](records::Cell& record) { record.status = "differs"; });
  now_.change<records::Cell>(FakeFarm::kDiffers, "cell.json",
                             [](records::Cell& record) { record.status = "pass"; });
  now_.farm().cells[0].status = "differs";
  now_.farm().cells[1].status = "pass";
  now_.write();
  EXPECT_THAT(publish().worse, ElementsAre(FakeFarm::kPass + ": POV-Ray: pass became differs"));
  EXPECT_THAT(sentence(), HasSubstr(": 1 cell is worse, 1 is better, 2 are as before."));
  EXPECT_THAT(cell(FakeFarm::kPass), HasSubstr("Worse than on "));
  EXPECT_THAT(cell(FakeFarm::kDiffers), HasSubstr("POV-Ray: differs became pass"));
}

TEST_F(Changes, CallALargerDifferenceWorseBeyondItsNoise) {
  set_worst(now_, FakeFarm::kPass, 4.03e-4);
  EXPECT_THAT(publish().worse, IsEmpty());
  set_worst(now_, FakeFarm::kPass, 5e-4);
  EXPECT_THAT(publish().worse, ElementsAre(HasSubstr("Largest difference, of the peak")));
  const std::string page = cell(FakeFarm::kPass);
  EXPECT_THAT(page, HasSubstr("▼ worse, +25 %"));
  EXPECT_THAT(page, HasSubstr("Largest difference, of the peak over the runs"));
  set_noise(was_, 3e-4, 6e-4);
  set_noise(now_, 3e-4, 6e-4);
  EXPECT_THAT(publish().worse, IsEmpty()) << "the bars overlap";
  set_noise(was_, 3e-4, 4.1e-4);
  set_noise(now_, 4.9e-4, 6e-4);
  EXPECT_EQ(publish().worse.size(), 1u);
}

TEST_F(Changes, CallADamagedPictureOfNowWorse) {
  write_file(now_.cell_directory(FakeFarm::kPass) / "povray.png", std::string_view("no picture"));
  EXPECT_THAT(publish().worse, ElementsAre(HasSubstr("pass became damaged")));
}

TEST_F(Changes, NameCellsThatAreGoneWithTheirStatus) {
  was_.leave_out({FakeFarm::kPass});
  now_.leave_out({FakeFarm::kDiffers});
  EXPECT_THAT(publish().worse, IsEmpty());
  EXPECT_THAT(sentence(), HasSubstr(": 1 cell is new, 1 is gone, 2 are as before."));
  EXPECT_THAT(index(), HasSubstr("Phong (RDF) · exponent 128, which was ≠ differs"));
  EXPECT_THAT(index(), HasSubstr("The earlier run did not have this cell"));
  EXPECT_THAT(cell(FakeFarm::kPass), HasSubstr("does not have this cell"));
}

TEST_F(Changes, CallAnUnrenderedCellNewAndALostPictureWorse) {
  was_.farm().cells[0].status = "missing";
  was_.write();
  fs::remove_all(was_.cell_directory(FakeFarm::kPass));
  fs::remove_all(now_.cell_directory(FakeFarm::kDiffers));
  now_.farm().cells[1].status = "missing";
  now_.write();
  EXPECT_THAT(publish().worse, ElementsAre(HasSubstr("differs became no picture")));
  EXPECT_THAT(sentence(), HasSubstr(": 1 cell is worse, 1 is new, 2 are as before."));
}

TEST_F(Changes, NameAnEngineThatIsNotThereAnyMore) {
  now_.change<records::Cell>(FakeFarm::kPass, "cell.json", [](records::Cell& record) {
    record.comparisons.clear();
    record.images.pop_back();
    record.status = "unchecked";
  });
  now_.farm().cells[0].status = "unchecked";
  now_.write();
  EXPECT_THAT(publish().worse, ElementsAre(HasSubstr("pass became not compared")));
  EXPECT_THAT(cell(FakeFarm::kPass), HasSubstr("✓ pass before, not compared now"));
}

TEST_F(Changes, TakeNothingFromADamagedBaseline) {
  write_file(was_.cell_directory(FakeFarm::kPass) / "cell.json", std::string_view("{"));
  write_file(was_.cell_directory(FakeFarm::kDiffers) / "lobelia-povray.json",
             std::string_view("[]"));
  EXPECT_THAT(publish().worse, IsEmpty());
  EXPECT_THAT(sentence(), HasSubstr(": 2 cells cannot be compared, 2 are as before."));
  EXPECT_THAT(cell(FakeFarm::kPass), HasSubstr("Of the earlier run: cell.json"));
  EXPECT_THAT(cell(FakeFarm::kPass), Not(HasSubstr(was_.directory().string())));
}

TEST_F(Changes, FollowNoLinkInABaseline) {
  const TemporaryDirectory elsewhere;
  write_file(elsewhere.path() / "secret", tiny_png());
  const fs::path picture = was_.cell_directory(FakeFarm::kPass) / "povray.png";
  fs::remove(picture);
  fs::create_symlink(elsewhere.path() / "secret", picture);
  was_.seal(FakeFarm::kPass);
  const fs::path whole = was_.cell_directory(FakeFarm::kDiffers);
  fs::rename(whole, elsewhere.path() / "cell");
  fs::create_directory_symlink(elsewhere.path() / "cell", whole);
  publish();
  EXPECT_THAT(sentence(), HasSubstr(": 2 cells cannot be compared, 2 are as before."));
  EXPECT_THAT(cell(FakeFarm::kPass), HasSubstr("povray.png is a link"));
  EXPECT_FALSE(fs::exists(site_.path() / "cells" / FakeFarm::kPass / "povray.before.png"));
}

TEST_F(Changes, RefuseByNameADirectoryThatIsNoFarm) {
  const auto code_of = [&](const fs::path& baseline) {
    try {
      publish({baseline});
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      return error.code();
    }
    return ExitCode::kSuccess;
  };
  const TemporaryDirectory empty;
  EXPECT_EQ(code_of(empty.path()), ExitCode::kInput);
  EXPECT_EQ(code_of(empty.path() / "nowhere"), ExitCode::kInput);
  EXPECT_EQ(code_of(now_.directory()), ExitCode::kUsage);
  fs::create_symlink(was_.directory() / "farm.json", empty.path() / "farm.json");
  EXPECT_EQ(code_of(empty.path()), ExitCode::kInput);
  EXPECT_FALSE(fs::exists(site_.path() / "index.html"));
}

TEST_F(Changes, ShowMarkupOfABaselineAsText) {
  const std::string hostile = "<script>alert(1)</script>";
  was_.farm().axes[0].values[0].label = hostile;
  was_.write();
  now_.leave_out({FakeFarm::kPass});
  was_.change<records::Comparison>(
      FakeFarm::kDiffers, "lobelia-povray.json",
      [&](records::Comparison& record) { record.metrics.emplace_back(hostile, 1); });
  publish();
  const Site site(site_.path());
  EXPECT_THAT(site.active_content(), IsEmpty());
  EXPECT_THAT(index(), HasSubstr(hostile));
  EXPECT_THAT(cell(FakeFarm::kDiffers), HasSubstr(hostile));
}

TEST_F(Changes, HaveATimelineOfEveryRunWithItsDate) {
  const FakeFarm oldest;
  set_worst(oldest, FakeFarm::kPass, 2e-4);
  const auto set_date = [](const FakeFarm& farm, int days) {
    fs::last_write_time(farm.directory() / "farm.json",
                        fs::file_time_type::clock::now() - std::chrono::hours(24 * days));
  };
  set_date(oldest, 20);
  set_date(was_, 10);
  publish({oldest.directory(), was_.directory()});
  const Site site(site_.path());
  const auto points =
      site.cell(FakeFarm::kPass)
          .select_nodes("//*[contains(@class,'timeline')]//g[@class='point']/title");
  ASSERT_EQ(points.size(), 3u);
  std::vector<std::string> words;
  for (const auto& point : points) words.push_back(text_of(point.node()));
  EXPECT_THAT(words[0], HasSubstr(": 0.02 %"));
  EXPECT_THAT(words[1], HasSubstr(": 0.04 %"));
  EXPECT_THAT(words[2], HasSubstr("this run: 0.04 %"));
  EXPECT_LT(words[0], words[1]) << "dates";
  EXPECT_LT(words[1], words[2]);
  EXPECT_THAT(
      text_of(site.cell(FakeFarm::kPass).select_node("//*[contains(@class,'timeline')]").node()),
      HasSubstr("limit"));
  EXPECT_THAT(sentence(), HasSubstr("Since " + words[1].substr(0, 10) + " ("));
}

TEST_F(Changes, AreRemovedByPublishingWithoutABaseline) {
  Image other(2, 2);
  other.values()[0] = 1;
  write_exr(was_.cell_directory(FakeFarm::kPass) / "povray.exr", other, {});
  was_.seal(FakeFarm::kPass);
  publish({});
  const auto before = files_below(site_.path());
  publish();
  EXPECT_TRUE(fs::exists(site_.path() / "cells" / FakeFarm::kPass / "povray.before.png"));
  publish({});
  EXPECT_EQ(files_below(site_.path()), before);
}

}  // namespace
}  // namespace lobelia::gallery
