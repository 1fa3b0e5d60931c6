// `lobelia compare`: pictures of differences, and how the pictures are looked at.
#include "tests/program/compare_pictures_fixture.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

class CompareMaps : public ComparePictures {
 protected:
  /// Folders A and B with three pairs: equal, off by 0.1 and off by 0.4.
  void SetUp() override {
    for (const char* side : {"A", "B"}) fs::create_directory(path(side));
    for (const auto& [name, off] :
         {std::pair("equal.exr", 0.0f), {"near.exr", 0.1f}, {"far.exr", 0.4f}}) {
      std::vector<float> a(32 * 32, 0.5f);
      a[33] += off;
      exr(std::string("A/") + name, 32, 32, {{"Y", a}});
      exr(std::string("B/") + name, 32, 32, {{"Y", std::vector<float>(32 * 32, 0.5f)}});
    }
  }
  fs::path map(const std::string& name) { return path("maps/" + name + ".exr.png"); }
  float brightest(const std::string& name) {
    return std::ranges::max(read_image(map(name)).values());
  }
  ProcessResult maps(std::vector<std::string> more) {
    fs::remove_all(path("maps"));
    more.insert(more.begin(), {"A", "B", "--diff-image", "maps"});
    return compare(more);
  }
};

TEST_F(CompareMaps, HaveOneScaleForAllPicturesOfFolders) {
  for (const std::string of : {"channels", "abs"}) {
    EXPECT_EQ(maps({"--diff-of", of}).exit_code, 1);
    EXPECT_LT(brightest("near"), 0.6f * brightest("far")) << of;
    EXPECT_LT(brightest("equal"), brightest("near")) << of;
  }
  EXPECT_EQ(maps({"--diff-scale", "0.01"}).exit_code, 1);
  EXPECT_EQ(brightest("near"), brightest("far"));
}

TEST_F(CompareMaps, StayInTheirFolderWhateverATableCallsThePair) {
  const std::string kLong(252, 'n');
  file("pairs.csv", "a,b,name\nA/far.exr,B/far.exr,../../evil\nA/near.exr,B/near.exr," +
                        path("evil").string() + "\nA/equal.exr,B/equal.exr," + kLong + "\n");
  EXPECT_EQ(compare({"--pairs", "pairs.csv", "--diff-image", "deep/maps"}).exit_code, 1);
  std::size_t inside = 0;
  for (const auto& entry : fs::directory_iterator(path("deep/maps")))
    inside += entry.is_regular_file();
  EXPECT_EQ(inside, 3u);
  EXPECT_FALSE(fs::exists(path("evil.png")));
  EXPECT_FALSE(fs::exists(directory_.path().parent_path() / "evil.png"));
}

TEST_F(CompareMaps, LeaveOutPairsThatPassOnRequest) {
  for (const std::string of : {"channels", "flip.ldr"}) {
    EXPECT_EQ(maps({"--diff-only-failed", "--diff-of", of}).exit_code, 1);
    EXPECT_FALSE(fs::exists(map("equal"))) << of;
    EXPECT_TRUE(fs::exists(map("near"))) << of;
    EXPECT_TRUE(fs::exists(map("far"))) << of;
  }
}

TEST_F(CompareMaps, ScaleFlipToOneAndExposuresToTheirRange) {
  const std::vector<std::string> pair{"A/far.exr", "B/far.exr", "--diff-image", "map.png",
                                      "--diff-of"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), pair.begin(), pair.end());
    return compare(more).output_tail;
  };
  EXPECT_THAT(with({"flip.ldr"}), HasSubstr("map.png: flip.ldr up to 1, the largest is"));
  EXPECT_THAT(with({"flip.hdr", "--exposures", "-2,2"}), HasSubstr("flip.hdr up to 1, "));
  EXPECT_THAT(with({"flip.hdr.exposure", "--exposures", "-2,3"}),
              HasSubstr("flip.hdr.exposure up to 3, "));
  EXPECT_THAT(with({"flip.hdr"}), HasSubstr("--diff-of flip.hdr needs --exposures"));
}

TEST_F(CompareMaps, TakeExposuresWithOneFreeEnd) {
  const auto exposures = [&](const std::string& range, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"A/far.exr", "B/far.exr", "--exposures", range});
    return record(more, 1)["viewing"]["hdrExposures"];
  };
  const Record all = exposures("auto"), stop = exposures("auto,4"), start = exposures("-2,auto"),
               both = exposures("-2,4"),
               curve = exposures("auto,auto,3", {"--tone-curve", "hable"});
  EXPECT_EQ(stop["startStops"], all["startStops"]);
  EXPECT_EQ(stop["stopStops"], 4.0);
  EXPECT_EQ(start["stopStops"], all["stopStops"]);
  EXPECT_EQ(start["startStops"], -2.0);
  EXPECT_TRUE(start["automatic"]);
  EXPECT_EQ(both["count"], 6);
  EXPECT_FALSE(both["automatic"]);
  EXPECT_EQ(curve["count"], 3);
  EXPECT_EQ(curve["toneCurve"], "hable");
  EXPECT_NE(curve["startStops"], all["startStops"]);
  for (const char* bad : {"1", "1,2,3,4", "auto,x", "2,1", "auto,auto,1", "nan,2", ",", "auto,1e9"})
    EXPECT_EQ(compare({"A/far.exr", "B/far.exr", "--exposures", bad}).exit_code, 2) << bad;
  EXPECT_EQ(compare({"A/far.exr", "B/far.exr", "--tone-curve", "aces"}).exit_code, 2);
}

TEST_F(CompareMaps, TheDisplayGivesThePixelsPerDegree) {
  const auto degrees = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"A/far.exr", "B/far.exr"});
    return record(more, 1)["viewing"]["pixelsPerDegree"].get<double>();
  };
  constexpr double kPi = 3.14159265358979323846;
  EXPECT_DOUBLE_EQ(degrees({}), 3840 * kPi / 180);
  EXPECT_DOUBLE_EQ(
      degrees({"--display-distance", "0.5", "--display-width", "0.6", "--display-pixels", "2560"}),
      0.5 * (2560 / 0.6) * kPi / 180);
  EXPECT_DOUBLE_EQ(degrees({"--display-width", "0.6"}), 0.7 * (3840 / 0.6) * kPi / 180);
  EXPECT_EQ(
      compare({"A/far.exr", "B/far.exr", "--display-width", "0.6", "--pixels-per-degree", "60"})
          .exit_code,
      2);
  EXPECT_EQ(compare({"A/far.exr", "B/far.exr", "--display-pixels", "1000000"}).exit_code, 2);
}

TEST_F(CompareMaps, TheSensitivityIsARecordToo) {
  const auto result =
      compare({"A/near.exr", "--sensitivity", "--json", "s.json", "--fail", "rmse=0.5"});
  EXPECT_THAT(result.output_tail, HasSubstr("changed copy"));
  const Record sensitivity = json("s.json");
  EXPECT_EQ(sensitivity["kind"], "sensitivity");
  EXPECT_EQ(sensitivity["asExpected"].get<bool>(), result.exit_code == 0);
  EXPECT_EQ(sensitivity["limits"][0]["metric"], "rmse");
  const Record& black = sensitivity["changes"][0];
  EXPECT_EQ(black["name"], "black");
  EXPECT_EQ(black["expected"], "found");
  EXPECT_EQ(black["verdict"], "differs");
  EXPECT_GT(black["foundBy"].size(), 0u);
  EXPECT_EQ(compare({"A/near.exr", "--sensitivity", "--csv", "s.csv"}).exit_code, 2);
  EXPECT_EQ(compare({"A/near.exr", "--sensitivity", "--json", "A/near.exr"}).exit_code, 2);
}

}  // namespace
}  // namespace lobelia
