#include <fmt/format.h>

#include "run_lobelia.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

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

TEST_F(ProfileCommand, PrintsTheBestExplanationFirst) {
  const auto result = run({"profile", "oblique_45.exr", "--scene", oblique_});
  EXPECT_THAT(result.output_tail,
              StartsWith("oblique_45: this highlight is best explained by exponent 64.00000 +- "
                         "0.00006 of Phong\n"));
  EXPECT_THAT(result.output_tail, HasSubstr(" of Blinn-Phong is "));
  EXPECT_THAT(result.output_tail, HasSubstr("GGX of alpha "));
  ASSERT_EQ(run({"render", oblique_, "--model", "modified_blinn_phong", "--exponent", "121", "-o",
                 "other.exr"})
                .exit_code,
            0);
  // The scene says Phong; what counts is the picture.
  EXPECT_THAT(run({"profile", "other.exr", "--scene", oblique_}).output_tail,
              StartsWith("other: this highlight is best explained by exponent 121.00000 +- 0.00012 "
                         "of Blinn-Phong times N.L\n"));
}

TEST_F(ProfileCommand, MeasuresEveryHighlightOfASceneUnlessOneIsChosen) {
  const Json all = record_of({"profile", "two_lights.exr", "--scene", two_lights_});
  EXPECT_EQ(all["kind"], "profiles");
  ASSERT_EQ(all["profiles"].size(), 2u);
  const Json one = record_of({"profile", "two_lights.exr", "--scene", two_lights_, "--light", "1"});
  EXPECT_EQ(one["kind"], "profile");
  EXPECT_EQ(one, all["profiles"][1]);
}

TEST_F(ProfileCommand, MeasuresEveryHighlightOfAPictureWithoutAScene) {
  const auto result = run({"profile", "oblique_45.exr", "two_lights.exr"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* words :
       {"as wide as a Gaussian of", "peak over background", "it falls off like a Gaussian",
        "2, oblique_45: no highlight of it is near and as bright"})
    EXPECT_THAT(result.output_tail, HasSubstr(words));
  EXPECT_THAT(result.output_tail, Not(HasSubstr("cosine lobe")));
  const Json blobs = record_of({"profile", "oblique_45.exr", "two_lights.exr"});
  EXPECT_EQ(blobs["kind"], "blobs");
  ASSERT_EQ(blobs["highlights"].size(), 2u);
  EXPECT_EQ(blobs["highlights"][0]["id"], 1);
  EXPECT_EQ(blobs["highlights"][0]["reference"], "two_lights");
  EXPECT_EQ(blobs["pictures"]["two_lights"]["standardErrorsFrom"], "scatter");
}

TEST_F(ProfileCommand, MeasuresTheHighlightAtAPlaceOrInARegion) {
  const Json all = record_of({"profile", "two_lights.exr"});
  ASSERT_EQ(all["highlights"].size(), 2u);
  const Json& second = all["highlights"][1]["images"]["two_lights"]["peak"];
  const int x = int(second["x"].get<double>()), y = int(second["y"].get<double>());
  const Json at = record_of({"profile", "two_lights.exr", "--at", fmt::format("{},{}", x, y)});
  EXPECT_EQ(at["kind"], "blob");
  EXPECT_EQ(at["images"]["two_lights"]["peak"], second);
  const Json inside = record_of(
      {"profile", "two_lights.exr", "--region", fmt::format("{},{},60,60", x - 30, y - 30)});
  ASSERT_EQ(inside["highlights"].size(), 1u);
  EXPECT_NEAR(inside["highlights"][0]["images"]["two_lights"]["peak"]["x"].get<double>(), x, 1);
}

TEST_F(ProfileCommand, WritesTablesAndChartsOrPrintsThem) {
  EXPECT_EQ(
      run({"profile", "two_lights.exr", "--scene", two_lights_, "--csv", "all.csv"}).exit_code, 0);
  const std::string all = text_of("all.csv");
  EXPECT_THAT(all, StartsWith("sphere,light,angleDegrees,pixels,analytic,two_lights\n0,0,"));
  EXPECT_THAT(all, HasSubstr("\n0,1,"));
  EXPECT_EQ(run({"profile", "two_lights.exr", "--csv", "blob.csv", "--svg", "blob.svg"}).exit_code,
            0);
  EXPECT_THAT(text_of("blob.csv"), StartsWith("highlight,axis,offsetPixels,two_lights\n1,major,-"));
  EXPECT_THAT(text_of("blob.csv"), HasSubstr("\n2,minor,-"));
  EXPECT_THAT(text_of("blob.svg"), HasSubstr("2: two_lights"));
  EXPECT_EQ(run({"profile", "two_lights.exr", "--at", "91,103", "--svg", "one.svg"}).exit_code, 0);
  EXPECT_THAT(text_of("one.svg"), HasSubstr("two_lights, short axis"));
  EXPECT_EQ(run({"profile", "oblique_45.exr", "--scene", oblique_, "--svg", "one.svg"}).exit_code,
            0);
  for (const char* words : {"flank", "blooming zone", "formula", "oblique_45"})
    EXPECT_THAT(text_of("one.svg"), HasSubstr(words));
  EXPECT_THAT(run({"profile", "two_lights.exr", "--csv", "-"}).output_tail,
              HasSubstr("\n2,minor,-25.0,"));
  EXPECT_THAT(run({"profile", "two_lights.exr", "--svg", "-"}).output_tail, HasSubstr("</svg>"));
  EXPECT_FALSE(std::filesystem::exists(directory_.path() / "-"));
}

TEST_F(ProfileCommand, RefusesUnsupportedInputInOneLine) {
  const struct {
    std::vector<std::string> arguments;
    int exit_code;
    std::string message;
  } mistakes[] = {
      {{"two_lights.exr", "--light", "1"}, 2, "--light requires --scene"},
      {{"two_lights.exr", "--exponent", "9"}, 2, "--exponent requires --scene"},
      {{"two_lights.exr", "--filter", "box"}, 2, "--filter requires --scene"},
      {{"two_lights.exr", "--scene", two_lights_, "--filter", "boks"}, 2, "boks"},
      {{"two_lights.exr", "--scene", two_lights_, "--filter", "box,0"},
       2,
       "--filter 'box,0': a radius is 0.1 to 16 pixels"},
      {{"two_lights.exr", "--scene", two_lights_, "--filter", "box,nan"}, 2, "a radius is"},
      {{"two_lights.exr", "--scene", two_lights_, "--svg", "a.svg"},
       2,
       "--svg draws one highlight"},
      {{"two_lights.exr", "--scene", two_lights_, "--light", "2"}, 3, "no light 2"},
      {{"two_lights.exr", "--scene", two_lights_, "--width", "9"}, 3, "256 x 256"},
      {{"missing.exr"}, 3, "missing.exr"},
      {{"two_lights.exr", "--at", "9"}, 2, "--at '9' has to be X,Y"},
      {{"two_lights.exr", "--at", "9,nan"}, 2, "has to be X,Y"},
      {{"two_lights.exr", "--at", "9,300"}, 3, "(9, 300) is outside of the picture"},
      {{"two_lights.exr", "--region", "1,2,3"}, 2, "has to be X,Y,W,H"},
      {{"two_lights.exr", "--region", "1,2,3.5,9"}, 2, "has to be whole pixels"},
      {{"two_lights.exr", "--region", "1,2,0,9"}, 3, "is not inside the picture"},
      {{"two_lights.exr", "--scene", two_lights_, "--at", "9,9"}, 2, "--scene excludes --at"},
      {{"two_lights.exr", "--b-error", "two_lights.exr"}, 2, "--b-error requires B"},
      {{"two_lights.exr", "--svg", "no/such/a.svg"}, 4, "no/such/a.svg"},
      {{"two_lights.exr", "--json", "two_lights.exr"}, 2, "is there and is no JSON"},
      {{"two_lights.exr", "oblique_45.exr", "--svg", "./oblique_45.exr"}, 2, "is read or written"},
      {{"two_lights.exr", "--replicate", "oblique_45.exr", "--csv", "oblique_45.exr"},
       2,
       "is read or written"},
      {{"two_lights.exr", "--json", "-", "--csv", "-"}, 2, "only one of"},
      {{"two_lights.exr", "--svg", ""}, 2, "it is empty"},
      {{"two_lights.exr", "--json", "x", "--csv", "./x"}, 2, "is read or written"},
      {{"two_lights.exr", "--scene", kScenes + "effects/crowd.xml", "--width", "256", "--height",
        "256"},
       3,
       "1024 spheres"},
  };
  for (const auto& [arguments, exit_code, message] : mistakes) {
    std::vector<std::string> command = arguments;
    command.insert(command.begin(), "profile");
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_one_line(run(command), exit_code, message);
  }
}

}  // namespace
}  // namespace lobelia
