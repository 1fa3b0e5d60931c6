// `lobelia compare` on parts of pictures.
#include "tests/program/compare_pictures_fixture.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

/// Grey pictures of 32 x 32 pixels, of which b is brighter on the first 4 x 8 pixels.
class CompareRegions : public ComparePictures {
 protected:
  void SetUp() override {
    std::vector<float> brighter(32 * 32, 0.5f), mask(32 * 32, 0.0f);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 4; ++x)
        brighter[std::size_t(32 * y + x)] = mask[std::size_t(32 * y + x)] = 0.75f;
    exr("a.exr", 32, 32, {{"Y", std::vector<float>(32 * 32, 0.5f)}});
    exr("b.exr", 32, 32, {{"Y", brighter}});
    exr("mask.exr", 32, 32, {{"Y", mask}});
    exr("small.exr", 2, 2, {{"Y", std::vector<float>(4, 1.0f)}});
  }
};

TEST_F(CompareRegions, AMaskIsARectangleAPolygonAPictureOrAllOfThem) {
  for (const char* mask : {"rect:0,0,4,8", "polygon:0,0 4,0 4,8 0,8", "mask.exr"}) {
    const Record one = record({"a.exr", "b.exr", "--mask", mask}, 1);
    EXPECT_EQ(one["mask"]["pixels"], 32) << mask;
    EXPECT_THAT(one["mask"]["of"], ElementsAre(mask));
    EXPECT_EQ(one["metrics"]["mae.mask"], 0.25);
    EXPECT_EQ(one["metrics"]["mae.outside"], 0);
  }
  const Record both =
      record({"a.exr", "b.exr", "--mask", "mask.exr", "--mask", "rect:30,30,9,9"}, 1);
  EXPECT_EQ(both["mask"]["pixels"], 36);
  const ProcessResult limited =
      compare({"a.exr", "b.exr", "--mask", "mask.exr", "--fail", "mae.mask=0.25",
               "--no-default-limits", "--metrics", "mae"});
  EXPECT_EQ(limited.exit_code, 0);
  EXPECT_THAT(limited.output_tail, HasSubstr("in the mask"));
  EXPECT_THAT(compare({"a.exr", "b.exr", "--fail", "rmse.mask=1"}).output_tail,
              HasSubstr("a limit on 'rmse.mask' needs a mask (--mask or --scene)"));
}

TEST_F(CompareRegions, LimitAMaskToSurfaces) {
  const std::string scene = kScenes + "head_on.xml";
  ASSERT_EQ(run_lobelia({"render", scene, "-o", "ball.exr"}, directory_.path()).exit_code, 0);
  const auto pixels = [&](std::vector<std::string> mask) {
    mask.insert(mask.begin(), {"ball.exr", "ball.exr", "--scene", scene});
    return record(mask, 0)["mask"]["pixels"].get<int>();
  };
  const int ball = pixels({});
  EXPECT_GT(ball, 128 * 128);
  EXPECT_LT(ball, 256 * 256 - 1000);
  EXPECT_EQ(2 * pixels({"--mask", "rect:0,0,256,128"}), ball);
}

TEST_F(CompareRegions, FailThePairIfTheirSizeIsNotThePictures) {
  const auto mask = compare({"a.exr", "b.exr", "--mask", "small.exr"});
  EXPECT_EQ(mask.exit_code, 3);
  EXPECT_THAT(mask.output_tail,
              HasSubstr("the mask small.exr has 2 x 2 pixels, the pictures have 32 x 32"));
  EXPECT_EQ(compare({"a.exr", "b.exr", "--crop", "0,0,33,1"}).exit_code, 3);
  const auto everything = compare({"a.exr", "b.exr", "--ignore", "rect:0,0,32,32"});
  EXPECT_EQ(everything.exit_code, 3);
  EXPECT_THAT(everything.output_tail, HasSubstr("nothing is left to compare"));
  for (const char* side : {"A", "B"}) {
    std::filesystem::create_directory(path(side));
    for (const char* name : {"big.exr", "small.exr"})
      std::filesystem::copy(path(name[0] == 'b' ? "a.exr" : name), path(side) / name);
  }
  const Record set = record({"A", "B", "--mask", "mask.exr"}, 3);
  EXPECT_EQ(set["summary"]["pass"], 1);
  EXPECT_EQ(set["summary"]["errors"], 1);
}

}  // namespace
}  // namespace lobelia
