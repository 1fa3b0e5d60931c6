#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_lobelia.hpp"
#include "tests/json.hpp"

namespace lobelia {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class ProfileCommand : public ::testing::Test {
 protected:
  ProfileCommand() {
    for (const char* name : {"oblique_45", "two_lights"})
      EXPECT_EQ(
          run({"render", kScenes + name + ".xml", "-o", std::string(name) + ".exr"}).exit_code, 0);
  }
  ProcessResult run(const std::vector<std::string>& arguments) const {
    return run_lobelia(arguments, directory_.path());
  }
  /// The record that it prints.
  Json record_of(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--json", "record.json"});
    EXPECT_EQ(run(arguments).exit_code, 0);
    return Json::parse(text_of("record.json"));
  }
  std::string text_of(const char* file) const {
    return read_file(directory_.path() / file, 1 << 24);
  }
  const std::string oblique_ = kScenes + "oblique_45.xml", two_lights_ = kScenes + "two_lights.xml";
  const TemporaryDirectory directory_;
};

TEST_F(ProfileCommand, SaysWhichCosineLobeTheHighlightIs) {
  const auto result = run({"profile", "two_lights.exr", "--scene", two_lights_});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output_tail, HasSubstr("sphere 0, light 1"));
  EXPECT_THAT(
      result.output_tail,
      HasSubstr("two_lights: this highlight is a cosine lobe of n = 64.00000 +- 0.00006 (but for"));
}

TEST_F(ProfileCommand, OfASceneMeasuresEveryHighlightUnlessOneIsChosen) {
  const Json all = record_of({"profile", "two_lights.exr", "--scene", two_lights_});
  EXPECT_EQ(all["kind"], "profiles");
  ASSERT_EQ(all["profiles"].size(), 2u);
  const Json one = record_of({"profile", "two_lights.exr", "--scene", two_lights_, "--light", "1"});
  EXPECT_EQ(one["kind"], "profile");
  EXPECT_EQ(one, all["profiles"][1]);
}

TEST_F(ProfileCommand, WithoutASceneMeasuresTheBrightestBlob) {
  const auto result = run({"profile", "oblique_45.exr", "two_lights.exr"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output_tail, HasSubstr("as wide as a Gaussian of"));
  EXPECT_THAT(result.output_tail, Not(HasSubstr("cosine lobe")));
  const Json blob = record_of({"profile", "oblique_45.exr", "two_lights.exr"});
  EXPECT_EQ(blob["kind"], "blob");
  EXPECT_EQ(blob["reference"], "two_lights");
  EXPECT_TRUE(blob["differences"].contains("oblique_45-two_lights"));
}

TEST_F(ProfileCommand, WritesTablesAndCharts) {
  EXPECT_EQ(
      run({"profile", "two_lights.exr", "--scene", two_lights_, "--csv", "all.csv"}).exit_code, 0);
  const std::string all = text_of("all.csv");
  EXPECT_THAT(all, StartsWith("sphere,light,angleDegrees,pixels,analytic,two_lights\n0,0,"));
  EXPECT_THAT(all, HasSubstr("\n0,1,"));
  EXPECT_EQ(run({"profile", "two_lights.exr", "--csv", "blob.csv", "--svg", "blob.svg"}).exit_code,
            0);
  EXPECT_THAT(text_of("blob.csv"), StartsWith("axis,offsetPixels,two_lights\nmajor,-"));
  EXPECT_THAT(text_of("blob.csv"), HasSubstr("\nminor,-"));
  EXPECT_THAT(text_of("blob.svg"), HasSubstr("two_lights, short axis"));
  EXPECT_EQ(run({"profile", "oblique_45.exr", "--scene", oblique_, "--svg", "one.svg"}).exit_code,
            0);
  for (const char* words : {"flank", "blooming zone", "formula", "oblique_45"})
    EXPECT_THAT(text_of("one.svg"), HasSubstr(words));
}

TEST_F(ProfileCommand, RefusesWhatItCannotDoInOneLine) {
  const struct {
    std::vector<std::string> arguments;
    int exit_code;
    std::string message;
  } mistakes[] = {
      {{"two_lights.exr", "--light", "1"}, 2, "--light requires --scene"},
      {{"two_lights.exr", "--exponent", "9"}, 2, "--exponent requires --scene"},
      {{"two_lights.exr", "--scene", two_lights_, "--svg", "a.svg"},
       2,
       "--svg draws one highlight"},
      {{"two_lights.exr", "--scene", two_lights_, "--light", "2"}, 3, "no light 2"},
      {{"two_lights.exr", "--scene", two_lights_, "--width", "9"}, 3, "256 x 256"},
      {{"missing.exr"}, 3, "missing.exr"},
      {{"two_lights.exr", "--svg", "no/such/a.svg"}, 4, "no/such/a.svg"},
      {{"two_lights.exr", "--scene", kScenes + "effects/crowd.xml", "--width", "256", "--height",
        "256"},
       3,
       "1024 spheres"},
  };
  for (const auto& [arguments, exit_code, message] : mistakes) {
    std::vector<std::string> command = arguments;
    command.insert(command.begin(), "profile");
    const auto result = run(command);
    EXPECT_EQ(result.exit_code, exit_code) << result.output_tail;
    EXPECT_THAT(result.output_tail, HasSubstr(message));
    EXPECT_EQ(std::count(result.output_tail.begin(), result.output_tail.end(), '\n'), 1)
        << result.output_tail;
  }
}

TEST_F(ProfileCommand, OfBlackAndOfOnePixelGivesAnAnswer) {
  for (const char* size : {"1", "2", "5"}) {
    ASSERT_EQ(
        run({"render", oblique_, "--width", size, "--height", size, "-o", "small.exr"}).exit_code,
        0);
    EXPECT_EQ(run({"profile", "small.exr"}).exit_code, 0);
    const auto result =
        run({"profile", "small.exr", "--scene", oblique_, "--width", size, "--height", size});
    EXPECT_EQ(result.exit_code, 0) << result.output_tail;
    EXPECT_THAT(result.output_tail, HasSubstr("no ")) << size;
  }
}

}  // namespace
}  // namespace lobelia
