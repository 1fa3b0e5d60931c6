#include "run_lobelia.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

ProcessResult render(const TemporaryDirectory& directory, const std::string& scene,
                     std::vector<std::string> options) {
  std::vector<std::string> arguments{"render", kScenes + scene, "--width", "48", "--height", "48",
                                     "-o",     "x.exr"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run_lobelia(arguments, directory.path());
}

TEST(RenderAccuracy, ExplainsItsChoiceWithTheErrorReached) {
  const TemporaryDirectory directory;
  const auto result = render(directory, "oblique_45.xml", {"--accuracy", "1e-1"});
  ASSERT_EQ(result.exit_code, 0) << result.output_tail;
  for (const char* words :
       {"accuracy 0.1: use pk3.1 in ", "the cheapest of", "so it holds", "formulas"})
    EXPECT_THAT(result.output_tail, HasSubstr(words));
  const Json record = read_json(directory.path() / "x.json");
  const Json& accuracy = record["accuracy"];
  EXPECT_EQ(accuracy["asked"], 0.1);
  EXPECT_EQ(accuracy["chose"]["lobe"], "pk3.1");
  EXPECT_EQ(accuracy["chose"]["samples"], 1);
  EXPECT_LE(accuracy["reached"]["value"], accuracy["predicted"]);
  EXPECT_EQ(accuracy["reached"]["held"], true);
  EXPECT_EQ(record["highlights"][0]["lobe"], "pk3.1");
  EXPECT_THAT(record["plan"]["precision"].get<std::string>(),
              HasSubstr(accuracy["chose"]["precision"].get<std::string>()));
}

TEST(RenderAccuracy, FailsIfTheErrorIsOutOfReach) {
  const TemporaryDirectory directory;
  const auto result = render(directory, "effects/area_light.xml",
                             {"--accuracy", "1e-6", "--max-samples", "4", "-q"});
  EXPECT_EQ(result.exit_code, 3) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr("cannot be reached with 4 samples"));
  EXPECT_THAT(result.output_tail, HasSubstr("the best possible is --accuracy 0."));
  EXPECT_EQ(files_in(directory.path()), 0u);
}

TEST(RenderAccuracy, RefusesOptionsChosenByItself) {
  const TemporaryDirectory directory;
  for (const char* text : {"", "0", "-1", "nan", "ten", "de2000=", "flip=1"}) {
    const auto result = render(directory, "head_on.xml", {"--accuracy", text});
    EXPECT_EQ(result.exit_code, 2) << text << result.output_tail;
    EXPECT_THAT(result.output_tail, HasSubstr("de2000=X"));
  }
  EXPECT_EQ(
      render(directory, "head_on.xml", {"--accuracy", "0.1", "--precision", "mixed"}).exit_code, 2);
  EXPECT_EQ(render(directory, "head_on.xml", {"--accuracy-check", "none"}).exit_code, 2);
  EXPECT_EQ(files_in(directory.path()), 0u);
}

TEST(CostCommand, MeasuresPictures) {
  const TemporaryDirectory directory;
  const auto result = run_lobelia(
      {"cost", "--quick", "--level", "picture", kScenes + "oblique_45.xml", "-o", "cost"},
      directory.path());
  ASSERT_EQ(result.exit_code, 0) << result.output_tail;
  const Json record = read_json(directory.path() / "cost" / "cost.json");
  EXPECT_FALSE(record.at("tables").at(0).at("ways").empty());
}

}  // namespace
}  // namespace lobelia
