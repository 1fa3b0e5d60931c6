// `lobelia compare` on files as they come: what it answers to each, and that it always answers.
#include <ImfTiledOutputFile.h>

#include <nlohmann/json.hpp>

#include "base/pictures/image_io.hpp"
#include "tests/base/picture_files.hpp"
#include "tests/program/compare_pictures_fixture.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

TEST_F(ComparePictures, RefusesFilesWithoutAPictureInOneLine) {
  const std::string good = good_exr();
  const auto expect_refused = [&](const std::string& name, const std::string& why) {
    for (const auto& [a, b] : {std::pair(name, std::string("good.exr")), {"good.exr", name}}) {
      SCOPED_TRACE(a + " " + b);
      const ProcessResult result = compare({a, b});
      expect_one_line(result, 3, why);
      EXPECT_THAT(result.output_tail, HasSubstr(name));
      EXPECT_FALSE(result.timed_out);
    }
  };
  file("text.png", "this is text");
  expect_refused("text.png", "not a readable picture");
  file("empty.exr", "");
  expect_refused("empty.exr", "not a readable picture");
  std::filesystem::create_directory(path("directory.exr"));
  expect_refused("directory.exr", "compare files with files, folders with folders");
  ASSERT_EQ(::mkfifo(path("pipe.exr").c_str(), 0600), 0);
  expect_refused("pipe.exr", "not a regular file");
  expect_refused("/dev/zero", "not a regular file");
  expect_refused("missing.exr", "no such file");
  file("half.exr", good.substr(0, good.size() / 2));
  expect_refused("half.exr", "not a readable picture");
}

TEST_F(ComparePictures, PassesEqualInfinitiesWhereAllowed) {
  const auto with_infinity = [&](const std::string& name, std::size_t at) {
    const std::vector<float> grey(32 * 32, 0.5f);
    std::vector<float> green = grey;
    green[at] = std::numeric_limits<float>::infinity();
    exr(name, 32, 32, {{"R", grey}, {"G", green}, {"B", grey}});
  };
  with_infinity("inf.exr", 32 * 7 + 5);
  const ProcessResult refused = compare({"inf.exr", "inf.exr"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.output_tail, HasSubstr("the first is inf in inf.exr at x 5, y 7, channel G"));
  const Record made = record({"inf.exr", "inf.exr", "--allow-equal-nonfinite"}, 0);
  EXPECT_EQ(made["verdict"], "pass");
  EXPECT_EQ(made["metrics"]["max_abs"], 0);
  EXPECT_EQ(made["nonfinite"], Record({{"a", 0}, {"b", 0}, {"equalAllowed", 1}}));

  flat("grey.exr", 0.5f);
  EXPECT_EQ(compare({"inf.exr", "grey.exr", "--allow-equal-nonfinite"}).exit_code, 1);

  // A difference picture of what is allowed is not full of magenta.
  ASSERT_EQ(compare({"inf.exr", "inf.exr", "--allow-equal-nonfinite", "--diff-image", "d.exr",
                     "--diff-of", "abs"})
                .exit_code,
            0);
  const Image difference = read_image(path("d.exr"));
  EXPECT_THAT(difference.values(), ::testing::Each(0));
  EXPECT_EQ(
      compare({"inf.exr", "inf.exr", "--allow-equal-nonfinite", "--a-error", "grey.exr"}).exit_code,
      2);
}

TEST_F(ComparePictures, MeasuresBlackPicturesWithoutHdrFlip) {
  std::vector<float> black(32 * 32, 0.0f);
  exr("black.exr", 32, 32, {{"Y", black}});
  black[40] = -0.01f;
  exr("below.exr", 32, 32, {{"Y", black}});
  const std::vector<std::string> pair{"below.exr", "black.exr", "--exposures", "auto",
                                      "--no-default-limits"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), pair.begin(), pair.end());
    return more;
  };
  const Record made = record(with({"--fail", "rmse=1"}), 0);
  for (const char* id : {"rmse", "relmse.eps=0.01", "max_abs"})
    EXPECT_TRUE(made["metrics"][id].is_number()) << id;
  EXPECT_TRUE(made["metrics"].contains("flip.ldr.mean"));
  EXPECT_FALSE(made["metrics"].contains("flip.hdr.mean"));
  EXPECT_FALSE(made["viewing"].contains("hdrExposures"));
  std::map<std::string, std::string> why;
  for (const Record& one : made["notMeasured"])
    if (one["metric"].get<std::string>().find("highlight") == std::string::npos)
      why[one["metric"]] = one["because"];
  EXPECT_THAT(why, UnorderedElementsAre(
                       Pair("flip.hdr.mean", HasSubstr("needs a reference with a pixel above 0")),
                       Pair("flip.hdr.max", HasSubstr("needs a reference with a pixel above 0")),
                       Pair("ms_ssim", HasSubstr("it needs 176 pixels a side"))));
  const std::string table = compare(with({"--fail", "rmse=1"})).output_tail;
  EXPECT_THAT(table, HasSubstr("not measured: the automatic range of exposures needs"));

  // Limits on metrics that were not measured.
  for (const char* limit : {"flip.hdr.mean=1", "ms_ssim=0"}) {
    const Record asked = record(with({"--fail", limit}), 1);
    EXPECT_EQ(asked["verdict"], "differs");
    EXPECT_EQ(asked["limits"][0]["pass"], false);
    EXPECT_EQ(asked["limits"][0]["value"], "nan");
  }
}

TEST_F(ComparePictures, DataOutsideTheDisplayWindowCount) {
  const auto box = window(0, 0, 32, 32), wide = window(-4, -4, 40, 40);
  const auto write = [&](const std::string& name, const Imath::Box2i& data, float outside) {
    std::vector<float> grey;
    for (int y = data.min.y; y <= data.max.y; ++y)
      for (int x = data.min.x; x <= data.max.x; ++x)
        grey.push_back(x < 0 || y < 0 || x >= 32 || y >= 32 ? outside : 0.5f);
    write_exr_parts(path(name), {{"", data, box, {{"Y", grey}}}});
  };
  write("one.exr", wide, 1);
  write("two.exr", wide, 2);
  const Record differs = record({"two.exr", "one.exr"}, 1);
  EXPECT_EQ(differs["verdict"], "differs");
  EXPECT_EQ(differs["metrics"]["max_abs"], 0) << "of the display window";
  EXPECT_EQ(differs["layers"][0]["metrics"]["max_abs"], 1);
  EXPECT_EQ(differs["layers"][0]["overscan"],
            Record({{"x", -4}, {"y", -4}, {"width", 40}, {"height", 40}}));
  EXPECT_THAT(compare({"two.exr", "one.exr"}).output_tail,
              HasSubstr("overscan of the picture: differs; max_rel_peak 1 (limit 0.01)"));
  EXPECT_EQ(record({"one.exr", "one.exr"}, 0)["layers"][0]["identical"], true);
  flat("noise.exr", 0.01f);
  const std::vector<std::string> with_noise = {"two.exr",   "one.exr", "--a-error",
                                               "noise.exr", "--fail",  "max_abs=0.5"};
  EXPECT_EQ(record(with_noise, 0)["notCompared"]["overscanPixels"], 576)
      << "the noise of the data is not known";
}

TEST_F(ComparePictures, SmallerMipLevelsAreNamed) {
  const auto write = [&](const std::string& name, float small) {
    Imf::Header header(16, 16);
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    header.setTileDescription({16, 16, Imf::MIPMAP_LEVELS});
    Imf::TiledOutputFile tiled(path(name).c_str(), header);
    for (int level = 0; level < tiled.numLevels(); ++level) {
      std::vector<float> grey(16 * 16, level == 0 ? 1 : small);
      Imf::FrameBuffer buffer;
      buffer.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(grey.data()), 4, 64));
      tiled.setFrameBuffer(buffer);
      tiled.writeTiles(0, tiled.numXTiles(level) - 1, 0, tiled.numYTiles(level) - 1, level);
    }
  };
  write("a.exr", 1);
  write("b.exr", 2);
  EXPECT_EQ(record({"a.exr", "b.exr"}, 0)["notCompared"]["mipLevels"], 4);
  EXPECT_THAT(compare({"a.exr", "b.exr"}).output_tail,
              HasSubstr("not compared: 4 smaller MIP levels"));
}

TEST_F(ComparePictures, FoldersNameInOneLineAllThatWasNotCompared) {
  for (const char* side : {"a", "b"}) {
    std::filesystem::create_directory(path(side));
    flat(std::string(side) + "/one.exr", 1, {channel("Z", 1)});
    flat(std::string(side) + "/two.exr", 1, {channel("N", 1)});
    flat(std::string(side) + "/whole.exr", 1);
  }
  const ProcessResult result = compare({"a", "b"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.output_tail,
              HasSubstr("\nnot compared, in 2 of the pairs: layers 'Z', 'N'\n"));
}

TEST_F(ComparePictures, TheFirstCommonLayerStandsForAPictureWithoutOne) {
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

TEST_F(ComparePictures, LargePicturesTakeLessMemoryThanTheirValues) {
  for (const char* name : {"head_on", "two_lights"})
    ASSERT_EQ(run_lobelia({"render", kScenes + name + ".xml", "--width", "8192", "--height", "4096",
                           "-q", "-o", name + std::string(".exr")},
                          directory_.path())
                  .exit_code,
              0);
  const auto result =
      run_lobelia({"compare", "two_lights.exr", "head_on.exr", "--no-default-limits", "--fail",
                   "max_abs=1e30", "--metrics", "max_abs,rmse,ciede2000,code"},
                  directory_.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  constexpr std::uint64_t kValues = std::uint64_t{2} * 8192 * 4096 * 3 * sizeof(float);
  EXPECT_LT(result.peak_memory_bytes, kValues / 2);
}

}  // namespace
}  // namespace lobelia
