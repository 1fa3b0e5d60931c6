// lobelia compare with folders, second references and its reports, as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/image_io.hpp"
#include "run_lobelia.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class CompareFolders : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(path("a/deep"));
    fs::create_directories(path("b/deep"));
  }
  fs::path path(const std::string& file) const { return folder_.path() / file; }
  void put(const std::string& file, float value, int width = 20) {
    Image image(width, 20);
    for (int x = 0; x < width; ++x) image.pixel(x, 3)[1] = value * float(x);
    write_exr(path(file), image, {});
  }
  ProcessResult compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    return run_lobelia(arguments, folder_.path());
  }
  nlohmann::json json(const std::string& file) const {
    return nlohmann::json::parse(read_file(path(file), 1 << 20));
  }
  std::string text(const std::string& file) const { return read_file(path(file), 1 << 20); }

  TemporaryDirectory folder_;
};

TEST_F(CompareFolders, WithEqualPicturesPassesAndSaysWhatHasNoReference) {
  put("a/x.exr", 0.1f), put("b/x.exr", 0.1f), put("a/deep/y.exr", 0.2f), put("b/deep/y.exr", 0.2f);
  put("a/new.exr", 0.1f);
  const auto result = compare({"a", "b"});
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr("extra       new.exr: there is no reference"));
  EXPECT_THAT(result.output_tail, HasSubstr("2 pairs: 2 pass"));
}

TEST_F(CompareFolders, FailsForAPictureThatIsMissing) {
  put("a/x.exr", 0.1f), put("b/x.exr", 0.1f), put("b/gone.exr", 0.1f);
  const auto result = compare({"a", "b"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output_tail, HasSubstr("missing     gone.exr"));
}

TEST_F(CompareFolders, GoesOnPastAPairThatCannotBeComparedAndWritesEveryReport) {
  put("a/small.exr", 0.1f, 10), put("b/small.exr", 0.1f, 20);
  write_file(path("a/text.png"), "text"), write_file(path("b/text.png"), "text");
  put("a/off.exr", 0.1f), put("b/off.exr", 0.2f), put("a/same.exr", 0.1f), put("b/same.exr", 0.1f);
  const auto result =
      compare({"a", "b", "--fail", "rmse=1e-4", "--json", "set.json", "--csv", "set.csv", "--junit",
               "set.xml", "--diff-image", "maps", "--diff-of", "abs"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.output_tail, HasSubstr("error       small.exr: the sizes differ"));
  EXPECT_THAT(result.output_tail, HasSubstr("error       text.png"));
  EXPECT_THAT(result.output_tail, HasSubstr("differs     off.exr: rmse is "));
  const auto record = json("set.json");
  EXPECT_EQ(record["kind"], "comparison-set");
  EXPECT_EQ(record["summary"]["pairs"], 4);
  EXPECT_EQ(record["summary"]["pass"], 1);
  EXPECT_EQ(record["summary"]["errors"], 2);
  EXPECT_THAT(text("set.csv"), HasSubstr("\r\noff.exr,differs,"));
  EXPECT_THAT(text("set.xml"), HasSubstr("tests=\"4\" failures=\"1\" errors=\"2\""));
  EXPECT_TRUE(fs::exists(path("maps/off.exr.png")));
  EXPECT_FALSE(fs::exists(path("maps/text.png.png")));
}

TEST_F(CompareFolders, WritesTheSameReportWithAnyNumberOfThreads) {
  for (int i = 0; i < 12; ++i) {
    put("a/" + std::to_string(i) + ".exr", 0.1f * float(i + 1));
    put("b/" + std::to_string(i) + ".exr", 0.11f * float(i + 1));
  }
  EXPECT_EQ(
      compare({"a", "b", "--threads", "1", "--csv", "one.csv", "--json", "one.json"}).exit_code, 1);
  EXPECT_EQ(
      compare({"a", "b", "--threads", "5", "--csv", "five.csv", "--json", "five.json"}).exit_code,
      1);
  EXPECT_EQ(text("one.csv"), text("five.csv"));
  EXPECT_EQ(text("one.json"), text("five.json"));
}

TEST_F(CompareFolders, WithNoPairAtAllIsNoSuccess) {
  EXPECT_EQ(compare({"a", "b"}).exit_code, 3);
  put("a/x.exr", 0.1f), put("b/y.exr", 0.1f);
  EXPECT_EQ(compare({"a", "b"}).exit_code, 3);
}

TEST_F(CompareFolders, AndAFileIsAMistakeSaidInWords) {
  put("b/x.exr", 0.1f);
  const auto result = compare({"a", "b/x.exr"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.output_tail, HasSubstr("a is a folder, but b/x.exr is not"));
}

TEST_F(CompareFolders, HaveOneRangeOfExposuresForTheWholeSet) {
  for (const auto& [name, value] : {std::pair{"dark.exr", 0.01f}, {"bright.exr", 9.0f}}) {
    Image image(16, 16);
    float level = value;
    for (float& v : image.values()) v = level, level += value / 200;
    for (const char* folder : {"a/", "b/"}) write_exr(path(folder + std::string(name)), image, {});
  }
  ASSERT_EQ(compare({"a", "b", "--exposures", "auto", "--json", "set.json"}).exit_code, 0);
  const auto pairs = json("set.json")["pairs"];
  const auto range = [&](std::size_t i) {
    return pairs[i]["comparison"]["viewing"]["hdrExposures"];
  };
  EXPECT_EQ(range(0), range(1));
  ASSERT_EQ(
      compare({"a/dark.exr", "b/dark.exr", "--exposures", "auto", "--json", "one.json"}).exit_code,
      0);
  EXPECT_LT(json("one.json")["viewing"]["hdrExposures"]["count"], range(0)["count"]);
}

TEST_F(CompareFolders, ShowHowFarTwoReferencesAreFromEachOther) {
  put("a/x.exr", 0.10f), put("b/x.exr", 0.11f), put("c.exr", 0.13f);
  const auto result =
      compare({"a/x.exr", "b/x.exr", "--reference-floor", "c.exr", "--json", "one.json"});
  EXPECT_EQ(result.exit_code, 1) << "the second reference has no part in the verdict";
  EXPECT_THAT(result.output_tail, HasSubstr("C and B"));
  const auto record = json("one.json");
  EXPECT_EQ(record["referenceFloor"]["c"], "c.exr");
  EXPECT_NEAR(record["referenceFloor"]["metrics"]["rmse"].get<double>(),
              2 * record["metrics"]["rmse"].get<double>(), 1e-6);
  EXPECT_EQ(compare({"a/x.exr", "b/x.exr", "--reference-floor", "none.exr"}).exit_code, 3);
}

TEST_F(CompareFolders, WarnWithoutFailing) {
  put("a/x.exr", 0.10f), put("b/x.exr", 0.11f);
  const auto result = compare({"a/x.exr", "b/x.exr", "--fail", "rmse=9", "--warn", "mae=1e-9",
                               "--warn", "ssim=0.1", "--json", "one.json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output_tail, HasSubstr("warning: mae"));
  EXPECT_EQ(json("one.json")["warnings"].size(), 2u);
  EXPECT_EQ(json("one.json")["warnings"][0]["pass"], false);
  EXPECT_EQ(json("one.json")["warnings"][1]["pass"], true);
  EXPECT_EQ(compare({"a/x.exr", "b/x.exr", "--warn", "rsme=1"}).exit_code, 2);
}

TEST_F(CompareFolders, WriteADifferenceAsColoursOrAsValues) {
  put("a/x.exr", 0.10f), put("b/x.exr", 0.11f);
  const auto write = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"a/x.exr", "b/x.exr", "--fail", "rmse=9", "--diff-image"});
    return compare(arguments).exit_code;
  };
  ASSERT_EQ(write({"d.png", "--diff-of", "abs", "--diff-colours", "viridis"}), 0);
  EXPECT_THAT(text("d.png"), HasSubstr("lobelia:colourMap"));
  EXPECT_THAT(text("d.png"), HasSubstr("viridis"));
  ASSERT_EQ(write({"d.exr", "--diff-of", "signed"}), 0);
  EXPECT_NEAR(read_image(path("d.exr")).pixel(10, 3)[0], -0.1f / 3, 1e-6);
  ASSERT_EQ(write({"channels.png"}), 0);
  EXPECT_THAT(text("channels.png"), HasSubstr("lobelia:scaleTo"));
  EXPECT_EQ(write({"d.jpg", "--diff-of", "abs"}), 2);
  EXPECT_EQ(write({"d.png", "--diff-of", "hue"}), 2);
  EXPECT_EQ(write({"d.png", "--diff-of", "abs", "--diff-colours", "magna"}), 2);
  EXPECT_EQ(write({"d.png", "--diff-colours", "magma"}), 2);
  EXPECT_EQ(write({"no/such/d.png"}), 4);
}

TEST_F(CompareFolders, WriteNothingOverAPictureNorOverEachOther) {
  put("a/x.exr", 0.10f), put("b/x.exr", 0.11f);
  const std::string before = text("b/x.exr");
  const auto refused = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"a/x.exr", "b/x.exr"});
    const auto result = compare(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.output_tail, HasSubstr("is read or written by this command already"));
  };
  refused({"--diff-image", "b/x.exr", "--diff-of", "abs"});
  refused({"--diff-image", "./b/../a/x.exr", "--diff-of", "abs"});
  refused({"--json", "b/x.exr"});
  refused({"--json", "r.json", "--csv", "r.json"});
  EXPECT_EQ(text("b/x.exr"), before);
  EXPECT_FALSE(fs::exists(path("r.json")));
}

}  // namespace
}  // namespace lobelia
