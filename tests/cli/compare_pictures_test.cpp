// `lobelia compare` on files as they come: what it answers to each, and that it always answers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "run_lobelia.hpp"
#include "tests/core/picture_files.hpp"

namespace lobelia {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using Record = nlohmann::json;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

class ComparePictures : public ::testing::Test {
 protected:
  void file(const std::string& name, const std::string& bytes) {
    write_file(directory_.path() / name, bytes);
  }
  void exr(const std::string& name, int width, int height,
           const std::vector<ExrChannel>& channels) {
    write_exr_channels(directory_.path() / name, width, height, channels);
  }
  /// R, G and B of one value each, and whatever else.
  void flat(const std::string& name, float value, std::vector<ExrChannel> more = {},
            Imf::PixelType type = Imf::FLOAT) {
    const std::vector<float> values(32 * 32, value);
    for (const char* channel : {"R", "G", "B"}) more.push_back({channel, values, type});
    exr(name, 32, 32, more);
  }
  ExrChannel channel(const char* name, float value) {
    return {name, std::vector<float>(32 * 32, value)};
  }
  ProcessResult compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    return run_lobelia(arguments, directory_.path());
  }
  /// Exit code and record.
  Record record(std::vector<std::string> arguments, int exit_code) {
    arguments.insert(arguments.end(), {"--json", "record.json"});
    const ProcessResult result = compare(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.output_tail;
    return Record::parse(read_file(directory_.path() / "record.json", 1 << 20), nullptr, false);
  }
  void expect_refused(const std::string& name, const std::string& why) {
    for (const bool first : {true, false}) {
      const ProcessResult result = compare({first ? name : "good.exr", first ? "good.exr" : name});
      EXPECT_EQ(result.exit_code, 3) << name << ": " << result.output_tail;
      EXPECT_THAT(result.output_tail, HasSubstr(name));
      EXPECT_THAT(result.output_tail, HasSubstr(why));
      // libpng says on stderr what it tells us as well.
      const std::string& output = result.output_tail;
      const std::size_t ours = output.starts_with("libpng error: ") ? output.find('\n') + 1 : 0;
      EXPECT_TRUE(output.substr(ours).starts_with("lobelia: ")) << output;
      EXPECT_EQ(std::count(output.begin() + std::ptrdiff_t(ours), output.end(), '\n'), 1) << output;
      EXPECT_FALSE(result.timed_out) << name;
    }
  }
  std::string good_exr() {
    flat("good.exr", 0.5f);
    return read_file(directory_.path() / "good.exr", 1 << 20);
  }
  TemporaryDirectory directory_;
};

TEST_F(ComparePictures, RefusesWhatIsNoPictureInOneLine) {
  const std::string good = good_exr();
  const Png flat{.width = 4, .height = 4, .samples = std::string(48, '\x55')};
  const std::string png = png_file(flat);
  file("text.png", "this is text");
  expect_refused("text.png", "not a readable picture");
  file("empty.exr", "");
  expect_refused("empty.exr", "not a readable picture");
  std::filesystem::create_directory(directory_.path() / "directory.exr");
  expect_refused("directory.exr", "not a regular file");
  ASSERT_EQ(::mkfifo((directory_.path() / "pipe.exr").c_str(), 0600), 0);
  expect_refused("pipe.exr", "not a regular file");
  expect_refused("/dev/zero", "not a regular file");
  expect_refused("missing.exr", "no such file");
  file("half.exr", good.substr(0, good.size() / 2));
  expect_refused("half.exr", "not a readable picture");
  file("half.png", png.substr(0, png.size() / 2));
  expect_refused("half.png", "not a readable picture");
  file("none.png", png_file({.width = 0, .height = 0}));
  expect_refused("none.png", "not a readable picture");
  std::string damaged = png;
  damaged[damaged.find("IDAT") + 20] ^= 1;
  file("damaged.png", damaged);
  expect_refused("damaged.png", "not a readable picture");
  const std::string jpeg = grey_jpeg_file(3);
  file("half.jpg", jpeg.substr(0, jpeg.size() / 2));
  expect_refused("half.jpg", "not a readable picture");
  file("long.ppm", "P6 100000 1 255\n" + std::string(300000, 'x'));
  expect_refused("long.ppm", "100000 x 1 pixels; at most 32768 a side");
}

TEST_F(ComparePictures, OfOtherSizesAreRefused) {
  good_exr();
  exr("small.exr", 2, 1, {{"Y", {1, 1}}});
  const ProcessResult result = compare({"small.exr", "good.exr"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.output_tail, HasSubstr("the sizes differ: 2 x 1 against 32 x 32"));
}

TEST_F(ComparePictures, NeverPassesANaN) {
  flat("nan.exr", kNaN);
  for (const auto& [a, b] : {std::pair{"nan.exr", "nan.exr"}, {"nan.exr", "good.exr"}}) {
    good_exr();
    const Record made = record({a, b, "--fail", "rmse=1e300"}, 1);
    EXPECT_EQ(made["verdict"], "non-finite");
    EXPECT_EQ(made["nonfinite"]["a"], 32 * 32);
  }
  std::vector<float> many(1000 * 1000, 0.5f);
  exr("clean.exr", 1000, 1000, {{"Y", many}});
  many[765432] = kNaN;
  exr("speck.exr", 1000, 1000, {{"Y", many}});
  const Record speck = record({"clean.exr", "speck.exr"}, 1);
  EXPECT_EQ(speck["verdict"], "non-finite");
  EXPECT_EQ(speck["nonfinite"]["b"], 1);
}

TEST_F(ComparePictures, BlackIsBlackAndNothingIsDividedByIt) {
  flat("black.exr", 0);
  const Record made = record({"black.exr", "black.exr"}, 0);
  EXPECT_EQ(made["verdict"], "pass");
  for (const auto& [id, value] : made["metrics"].items())
    if (id != "psnr") {
      EXPECT_TRUE(value.is_number()) << id << " " << value;
    }
  EXPECT_EQ(made["metrics"]["relmse.eps=0.01"], 0);
  EXPECT_EQ(made["metrics"]["max_rel_peak"], 0);
}

TEST_F(ComparePictures, HalfAgainstFloatPassesWithItsRounding) {
  flat("float.exr", 0.3f);
  flat("half.exr", 0.3f, {}, Imf::HALF);
  const Record made = record({"half.exr", "float.exr"}, 0);
  EXPECT_EQ(made["pictures"]["a"]["valueType"], "half");
  EXPECT_EQ(made["pictures"]["b"]["valueType"], "float");
  // 0.3 lies between halves that are 2^-12 apart, and rounds up.
  EXPECT_DOUBLE_EQ(made["metrics"]["max_abs"], double(float(half(0.3f))) - double(0.3f));
  EXPECT_GT(made["metrics"]["max_abs"], 0);
}

TEST_F(ComparePictures, GreyIsRgbOfEqualValuesAndAlphaIsNoPartOfThePicture) {
  flat("rgb.exr", 0.25f);
  flat("rgba.exr", 0.25f, {channel("A", 0.5f)});
  exr("y.exr", 32, 32, {channel("Y", 0.25f)});
  for (const char* other : {"rgba.exr", "y.exr"})
    EXPECT_EQ(record({other, "rgb.exr", "--fail", "max_abs=0"}, 0)["verdict"], "pass") << other;
}

TEST_F(ComparePictures, OneLayerIsComparedByItsName) {
  flat("a.exr", 1,
       {channel("diffuse.R", 1), channel("diffuse.G", 2), channel("diffuse.B", 3),
        channel("Z", 70)});
  flat(
      "b.exr", 9,
      {channel("diffuse.R", 1), channel("diffuse.G", 2), channel("diffuse.B", 3), channel("Z", 7)});
  EXPECT_EQ(compare({"a.exr", "b.exr"}).exit_code, 1);
  const Record made = record({"a.exr", "b.exr", "--layer", "diffuse"}, 0);
  EXPECT_EQ(made["pictures"]["b"]["layer"], "diffuse");
  EXPECT_EQ(made["pictures"]["b"]["channels"], Record({"diffuse.R", "diffuse.G", "diffuse.B"}));
  EXPECT_EQ(compare({"a.exr", "b.exr", "--layer", "Z"}).exit_code, 1);
  const ProcessResult unknown = compare({"a.exr", "b.exr", "--layer", "difuse"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.output_tail,
              HasSubstr("no layer 'difuse'; did you mean 'diffuse'?; there are 'diffuse', 'Z'"));
}

TEST_F(ComparePictures, WithAllLayersTheWorstIsTheVerdictAndEachHasItsFigures) {
  flat("a.exr", 1, {channel("A", 0.5f), channel("Z", 70), channel("same.Y", 1)});
  flat("b.exr", 1, {channel("A", 0.75f), channel("same.Y", 1), channel("id", 3)});
  EXPECT_EQ(compare({"a.exr", "b.exr"}).exit_code, 0) << "alpha is asked for with all layers alone";
  const Record made = record({"a.exr", "b.exr", "--all-layers"}, 1);
  EXPECT_EQ(made["verdict"], "differs");
  EXPECT_EQ(made["metrics"]["max_abs"], 0);
  ASSERT_EQ(made["layers"].size(), 2u);
  for (const Record& layer : made["layers"]) {
    const bool alpha = layer["layer"] == "A";
    EXPECT_EQ(layer["verdict"], alpha ? "differs" : "pass");
    EXPECT_EQ(layer["metrics"]["max_abs"], alpha ? 0.25 : 0);
    EXPECT_EQ(layer["pictures"]["a"]["layer"], layer["layer"]);
  }
  EXPECT_EQ(made["layersInOne"]["a"], Record({"Z"}));
  EXPECT_EQ(made["layersInOne"]["b"], Record({"id"}));
  const std::string table = compare({"a.exr", "b.exr", "--all-layers"}).output_tail;
  EXPECT_THAT(table, HasSubstr("layer A: differs; max_rel_peak 0.3333 (limit 0.01)"));
  EXPECT_THAT(table, HasSubstr("only in a: Z"));
  EXPECT_THAT(table, HasSubstr("only in b: id"));
  EXPECT_THAT(table, HasSubstr("verdict: differs"));

  flat("c.exr", 1, {channel("A", kNaN)});
  EXPECT_EQ(record({"c.exr", "b.exr", "--all-layers"}, 1)["verdict"], "non-finite");
}

TEST_F(ComparePictures, WithAllLayersAndNoPictureTheFirstCommonLayerStandsForIt) {
  exr("a.exr", 32, 32, {channel("u", 1), channel("v", 2)});
  EXPECT_EQ(compare({"a.exr", "a.exr"}).exit_code, 3);
  const Record made = record({"a.exr", "a.exr", "--all-layers"}, 0);
  EXPECT_EQ(made["pictures"]["a"]["layer"], "u");
  EXPECT_EQ(made["layers"][0]["layer"], "v");
  exr("b.exr", 32, 32, {channel("s", 1), channel("t", 2)});
  const ProcessResult nothing = compare({"a.exr", "b.exr", "--all-layers"});
  EXPECT_EQ(nothing.exit_code, 3);
  EXPECT_THAT(nothing.output_tail, HasSubstr("no layer of one name"));
}

TEST_F(ComparePictures, FramesOfAnAnimationAreLayers) {
  const std::string white = "\xff\xff\xff";
  file("one.gif", gif_file({white}));
  file("three.gif", gif_file({white, white, white}));
  const Record made = record({"one.gif", "three.gif", "--all-layers"}, 0);
  EXPECT_EQ(made["layers"].size(), 1u) << "the first one's alpha";
  EXPECT_EQ(made["layersInOne"]["b"], Record({"part2", "part2.A", "part3", "part3.A"}));
}

}  // namespace
}  // namespace lobelia
