// A gallery shows "pass" only of pictures and records that are as the farm wrote them.
#include <regex>

#include "base/pictures/image_io.hpp"
#include "base/records/comparison.hpp"
#include "base/words/text.hpp"
#include "gallery/cells/checked_cell.hpp"
#include "gallery/site/gallery.hpp"
#include "tests/gallery/fake_farm.hpp"
#include "tests/gallery/site.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia::gallery {
namespace {

constexpr std::uint64_t kMostBytes = 1 << 24;

class GalleryEvidence : public ::testing::Test {
 protected:
  GalleryEvidence() {
    Image image(4, 4);
    for (std::size_t i = 0; i < image.values().size(); ++i) image.values()[i] = 0.1f * float(i);
    for (const char* engine : {"lobelia", "povray"}) write_picture(engine, image);
    farm_.seal(FakeFarm::kPass);
  }
  fs::path file(const std::string& name) const {
    return farm_.cell_directory(FakeFarm::kPass) / name;
  }
  void write_picture(const std::string& engine, const Image& image) const {
    fs::remove(file(engine + ".exr"));
    write_exr(file(engine + ".exr"), image, {});
  }
  /// The picture by `engine` with one value changed.
  void change_value(const std::string& engine, const std::function<float(float)>& changed) const {
    Image image = read_image(file(engine + ".exr"));
    image.pixel(2, 1)[1] = changed(image.pixel(2, 1)[1]);
    write_picture(engine, image);
  }
  void cut(const std::string& name, double share) const {
    const std::string text = read_file(file(name), kMostBytes);
    write_file(file(name), text.substr(0, std::size_t(double(text.size()) * share)));
  }
  void flip_bit(const std::string& name, std::size_t bit) const {
    std::string text = read_file(file(name), kMostBytes);
    text.at(bit / 8) = char(text.at(bit / 8) ^ (1 << bit % 8));
    write_file(file(name), text);
  }
  /// Publishes and returns the state of the cell, in the words of the index; what it is in is the same everywhere.
  std::string state() {
    const PublishedGallery made = write_gallery(farm_.directory(), options_);
    doubts_ = made.doubts;
    const fs::path& directory = options_.site.empty() ? farm_.directory() : options_.site;
    const Site site(directory);
    EXPECT_THAT(site.bad_links(), IsEmpty());
    const std::string place =
        "//li[@data-status][.//a[contains(@href,'" + FakeFarm::kPass + "/index.html')]]";
    const std::string state =
        site.page("index.html").select_node((place + "/@data-status").c_str()).attribute().value();
    cell_text_ = text_of(site.cell(FakeFarm::kPass));
    index_text_ = text_of(site.page("index.html"));
    passes_ = site.cell(FakeFarm::kPass).select_nodes("//*[@class='status pass']").size();
    const std::string verdict = site.cell(FakeFarm::kPass)
                                    .select_node("//div[starts-with(@class,'verdict')]/@class")
                                    .attribute()
                                    .value();
    EXPECT_EQ(verdict, "verdict " + state);
    const std::string data = read_file(directory / "grid.data.js", kMostBytes);
    std::smatch of_cells;
    const std::regex lists(R"re("ids":\[([^\]]*)\].*"status":\[([^\]]*)\])re");
    EXPECT_TRUE(std::regex_search(data, of_cells, lists));
    const std::vector<std::string> ids = split(of_cells[1].str(), ","),
                                   places = split(of_cells[2].str(), ",");
    const auto at = std::ranges::find(ids, '"' + FakeFarm::kPass + '"') - ids.begin();
    EXPECT_EQ(info(kWorstFirst[std::stoul(places[at])]).name, state);
    return state;
  }
  /// The cell's state is `wanted`, the page says `words`, and nothing anywhere calls it a pass.
  void expect_state(const std::string& wanted, const std::string& words) {
    EXPECT_EQ(state(), wanted);
    EXPECT_THAT(cell_text_, HasSubstr(words));
    EXPECT_EQ(passes_, 0u);
    EXPECT_THAT(index_text_, HasSubstr("1 cell is not what the farm wrote."));
    EXPECT_THAT(doubts_, ElementsAre(HasSubstr(FakeFarm::kPass + ": ")));
  }

  FakeFarm farm_;
  GalleryOptions options_;
  std::vector<std::string> doubts_;
  std::string cell_text_, index_text_;
  std::size_t passes_ = 0;  ///< places on the cell's page that say so of the cell
};

TEST_F(GalleryEvidence, IsAPassForAFarmThatNobodyTouched) {
  EXPECT_EQ(state(), "pass");
  EXPECT_THAT(doubts_, IsEmpty());
  EXPECT_THAT(cell_text_, HasSubstr("✓ pass"));
  EXPECT_THAT(index_text_, Not(HasSubstr("not what the farm wrote")));
  EXPECT_EQ(state(), "pass") << "its own pages are not taken for evidence";
}

TEST_F(GalleryEvidence, MakesACellMissingWhicheverFileIsGone) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(farm_.cell_directory(FakeFarm::kPass)))
    names.insert(entry.path().filename().string());
  ASSERT_EQ(names.size(), 13u);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const std::string text = read_file(file(name), kMostBytes);
    fs::remove(file(name));
    expect_state("lost", name == "cell.json" ? "cell.json: cannot read" : name + " is missing.");
    write_file(file(name), text);
    EXPECT_EQ(state(), "pass");
  }
}

TEST_F(GalleryEvidence, MakesACellDamagedByValuesThatAreNotFinite) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    const std::string text = read_file(file("povray.exr"), kMostBytes);
    change_value("povray", [&](float) { return bad; });
    expect_state("damaged", "povray.exr has 1 pixel that is not finite.");
    write_file(file("povray.exr"), text);
  }
}

TEST_F(GalleryEvidence, MakesACellDamagedWhereverAFileIsCutOff) {
  for (const char* name : {"lobelia.exr", "povray.png", "lobelia-povray.json", "cell.json"})
    for (const double share : {0.0, 0.3, 0.98}) {
      SCOPED_TRACE(name);
      const std::string text = read_file(file(name), kMostBytes);
      cut(name, share);
      const std::string found = state();
      EXPECT_EQ(found, "damaged") << share;
      EXPECT_THAT(doubts_, ElementsAre(HasSubstr(": damaged: ")));
      write_file(file(name), text);
    }
}

TEST_F(GalleryEvidence, IsNeverAPassWithAnyBitFlipped) {
  std::mt19937 random(18);
  for (const char* name :
       {"lobelia.exr", "povray.exr", "povray.png", "lobelia-povray.png", "lobelia-povray.json",
        "povray.json", "profile.json", "scene.xml", "povray.log", "cell.json"})
    for (int times = 0; times < 4 * more_samples(); ++times) {
      const std::string text = read_file(file(name), kMostBytes);
      const std::size_t bit = random() % (8 * text.size());
      SCOPED_TRACE(name + (" bit " + std::to_string(bit)));
      flip_bit(name, bit);
      const std::string found = state();
      EXPECT_THAT(found, testing::AnyOf("changed", "damaged"));
      EXPECT_EQ(passes_, 0u);
      EXPECT_EQ(doubts_.size(), 1u);
      write_file(file(name), text);
    }
}

TEST_F(GalleryEvidence, IsCheckedForASiteOfItsOwnAndForMetricsAlone) {
  const TemporaryDirectory elsewhere;
  for (const bool metrics_only : {false, true}) {
    options_.metrics_only = metrics_only;
    options_.site = elsewhere.path() / "site";
    EXPECT_EQ(state(), "pass");
    const std::string text = read_file(file("povray.exr"), kMostBytes);
    change_value("povray", [](float value) { return value - 0.42f; });
    expect_state("changed", "povray.exr is not the file");
    EXPECT_FALSE(fs::exists(options_.site / "cells" / FakeFarm::kPass / "povray.exr"));
    write_file(file("povray.exr"), text);
  }
}

TEST_F(GalleryEvidence, IsNotSealedAndNoPassWithoutHashes) {
  const std::string sealed = read_file(file("cell.json"), kMostBytes);
  write_file(file("cell.json"), std::regex_replace(sealed, std::regex(R"(,\s*"seal": "\w+")"), ""));
  expect_state("unsealed", "without hashes");
  write_file(file("cell.json"), sealed);
  // One file that was put in without its hash is enough.
  farm_.change<records::Cell>(FakeFarm::kPass, "cell.json", [](records::Cell& cell) {
    std::erase_if(cell.files, [](const auto& one) { return one.name == "povray.exr"; });
  });
  expect_state("unsealed", "without hashes");
  farm_.change<records::Cell>(FakeFarm::kPass, "cell.json",
                              [](records::Cell& cell) { cell.files.clear(); });
  expect_state("unsealed", "without hashes");
}

TEST_F(GalleryEvidence, IsJudgedByItsFiguresIfEditedConsistently) {
  const auto change = [&](auto how) {
    farm_.change<records::Comparison>(FakeFarm::kPass, "lobelia-povray.json", how);
  };
  const auto set_outliers = [](records::Comparison& record, double count) {
    std::ranges::find(record.metrics, "outliers", [](const auto& m) { return m.first; })->second =
        count;
  };
  change([&](records::Comparison& record) { set_outliers(record, 9); });
  EXPECT_EQ(state(), "differs");
  EXPECT_THAT(cell_text_,
              HasSubstr("lobelia-povray.json says “pass”, but its figures say “differs”."));
  EXPECT_THAT(cell_text_, HasSubstr("cell.json says “pass”, but its figures say “differs”."));
  EXPECT_EQ(doubts_.size(), 1u);

  change([&](records::Comparison& record) {
    set_outliers(record, 1);
    record.nonfinite.b = 1;
  });
  EXPECT_EQ(state(), "differs");
  EXPECT_THAT(cell_text_, HasSubstr("its figures say “non-finite”"));

  change([](records::Comparison& record) {
    record.nonfinite.b = 0;
    record.limits.clear();
  });
  EXPECT_EQ(state(), "damaged") << "nothing was judged";
}

TEST_F(GalleryEvidence, IsNoPassWithoutTheComparison) {
  farm_.change<records::Cell>(FakeFarm::kPass, "cell.json",
                              [](records::Cell& cell) { cell.comparisons.clear(); });
  EXPECT_EQ(state(), "missing");
  EXPECT_THAT(cell_text_, HasSubstr("cell.json says “pass”, but its figures say “no picture”."));
  farm_.change<records::Cell>(FakeFarm::kPass, "cell.json",
                              [](records::Cell& cell) { cell.images.pop_back(); });
  EXPECT_EQ(state(), "unchecked");
}

TEST(GalleryJudgement, IsThatOfTheLimitsWithNoiseAndWithout) {
  const Metrics metrics(some_metrics());
  records::Comparison comparison;
  EXPECT_EQ(judge(comparison, metrics), "differs") << "without a limit nothing passes";
  const double nan = std::numeric_limits<double>::quiet_NaN();
  comparison.metrics = {{"outliers", 2}, {"ssim", 0.99}, {"drift", -0.5}, {"psnr", nan}};
  const auto with = [&](const std::string& metric, double limit, bool noisy = false) {
    comparison.limits = {{metric, limit, 0, true, noisy ? "holds" : "", std::nullopt}};
    return judge(comparison, metrics);
  };
  EXPECT_EQ(with("outliers", 2), "pass");
  EXPECT_EQ(with("outliers", 1), "differs");
  EXPECT_EQ(with("ssim", 0.98), "pass");
  EXPECT_EQ(with("ssim", 0.995), "differs");
  EXPECT_EQ(with("drift", 0.5), "pass");
  EXPECT_EQ(with("drift", 0.4), "differs") << "of either sign";
  EXPECT_EQ(with("psnr", 1), "differs") << "what is no number passes no limit";
  EXPECT_EQ(with("outliers", nan), "differs");
  comparison.error_bars = {{"drift", {0, 0, 0, -0.6, -0.4}}, {"ssim", {0, 0, 0, 0.97, 0.995}}};
  EXPECT_EQ(with("drift", 0.7, true), "same");
  EXPECT_EQ(with("drift", 0.5, true), "undecided");
  EXPECT_EQ(with("drift", 0.3, true), "different");
  EXPECT_EQ(with("ssim", 0.98, true), "undecided");
  EXPECT_EQ(with("psnr", 1, true), "undecided");
  comparison.nonfinite.b = 1;
  EXPECT_EQ(with("outliers", 2), "non-finite");
}

}  // namespace
}  // namespace lobelia::gallery
