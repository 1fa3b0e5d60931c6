#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>

#include <atomic>
#include <thread>

#include "base/pictures/image_io.hpp"
#include "base/system/files.hpp"
#include "tests/renderer/scene_text.hpp"

namespace lobelia {
namespace {

std::string emitter(const std::string& type, const std::string& body) {
  return "<emitter type=\"" + type + "\">" + body + "</emitter>";
}
std::string envmap(const std::string& file) {
  return emitter("envmap", given("string", "filename", file));
}

/// A directory scenes/ with the picture sky.exr, in one that has private.exr.
class EnvironmentMap : public testing::Test {
 protected:
  EnvironmentMap() {
    fs::create_directories(directory() / "below");
    write_exr(directory() / "sky.exr", sky(0.5f), {});
    write_exr(directory() / "below/sky & 'sea'.exr", sky(0.25f), {});
    write_exr(outside_.path() / "private.exr", sky(1), {});
  }
  fs::path directory() const { return outside_.path() / "scenes"; }
  static Image sky(float value) {
    Image image(4, 2);
    for (float& v : image.values()) v = value;
    return image;
  }
  std::string error(const std::string& file) const {
    return error_of(scene(envmap(file)), directory());
  }

  TemporaryDirectory outside_;
};

TEST_F(EnvironmentMap, IsRefusedBeforeItUnpacksToFarMoreThanItsFile) {
  constexpr int kSide = 4300;
  DisplayImage black{kSide, kSide, {}};
  black.rgb.resize(std::size_t{3} * kSide * kSide);
  write_png(directory() / "bomb.png", black);
  const auto bytes = fs::file_size(directory() / "bomb.png");
  ASSERT_LT(bytes, 100'000u) << "or it may be read";
  EXPECT_THAT(
      error("bomb.png"),
      HasSubstr(fmt::format("claims 18490000 pixels in a file of {} bytes; allowed here: 16777216, "
                            "and 16 more for each byte",
                            bytes)));
}

TEST(SceneLights, EveryKindIsReadAndWrittenToTheLastDigit) {
  const Scene s =
      again(parse_scene(scene(emitter("sphere", given("point", "center", "0.1, 0.2, 0.3") +
                                                    given("float", "radius", "0.7") +
                                                    given("rgb", "radiance", "1, 2, 0.3")) +
                              emitter("rectangle", given("point", "center", "0, 3, 0") +
                                                       given("vector", "half_u", "0.3, 0, 0.1") +
                                                       given("vector", "half_v", "-0.1, 0, 0.3") +
                                                       given("rgb", "radiance", "12.3")) +
                              emitter("constant", given("rgb", "radiance", "0.1, 0.2, 0.7")) +
                              emitter("sphere", "") + emitter("constant", "")),
                        "s.xml"));
  ASSERT_EQ(s.lights.size(), 5u);
  const auto& ball = std::get<SphereLight>(s.lights[0]);
  EXPECT_EQ(ball.center, (Vec3{0.1, 0.2, 0.3}));
  EXPECT_EQ(ball.radius, 0.7);
  EXPECT_EQ(ball.radiance, (Rgb{1, 2, 0.3}));
  const auto& rectangle = std::get<RectangleLight>(s.lights[1]);
  EXPECT_EQ(rectangle.center, (Vec3{0, 3, 0}));
  EXPECT_EQ(rectangle.half_u, (Vec3{0.3, 0, 0.1}));
  EXPECT_EQ(rectangle.half_v, (Vec3{-0.1, 0, 0.3}));
  EXPECT_EQ(rectangle.radiance, (Rgb{12.3, 12.3, 12.3}));
  EXPECT_EQ(std::get<ConstantLight>(s.lights[2]).radiance, (Rgb{0.1, 0.2, 0.7}));
  EXPECT_EQ(std::get<SphereLight>(s.lights[3]).radius, 1);
  EXPECT_EQ(std::get<ConstantLight>(s.lights[4]).radiance, (Rgb{1, 1, 1}));
}

TEST(SceneLights, APointMayBeOneOfASurface) {
  const std::string position = given("point", "position", "1, 2, 3");
  const Scene s =
      again(parse_scene(scene(emitter("point", position) +
                              emitter("point", position + given("vector", "normal", "0, -3, 4"))),
                        "s.xml"));
  ASSERT_EQ(s.lights.size(), 2u);
  EXPECT_EQ(std::get<PointLight>(s.lights[0]).normal, Vec3{});
  EXPECT_EQ(std::get<PointLight>(s.lights[1]).normal, (Vec3{0, -0.6, 0.8}));
}

TEST(SceneLights, EveryErrorHasItsPlace) {
  const std::string u = given("vector", "half_u", "1,0,0");
  const BadScene bad[] = {
      {scene(emitter("sphere", given("rgb", "radiance", "1e400"))),
       "s.xml:3:52: radiance '1e400' is not a finite number; allowed: 0 to 1e+09 W/(m^2 sr)"},
      {scene(emitter("constant", given("rgb", "radiance", "0, nan, 0"))),
       "s.xml:3:54: radiance '0, nan, 0' is not a finite number; allowed: 0 to 1e+09 W/(m^2 sr)"},
      {scene(emitter("rectangle", u)),
       "s.xml:3:2: <emitter type=\"rectangle\"> needs the parameter 'half_v' (to the next side; "
       "perpendicular to half_u; it shines to the side of half_u x half_v)"},
      {scene(emitter("rectangle", u + given("vector", "half_v", "0,0,0"))),
       "s.xml:3:93: half_v is 0 long; allowed: 1e-09 or more"},
      {scene(emitter("rectangle", u + given("vector", "half_v", "1e-3,1,0"))),
       "s.xml:3:2: half_u and half_v are not perpendicular: the cosine between them is 0.001; "
       "allowed: -1e-06 to 1e-06"},
      {scene(emitter("rectangle", u + given("vector", "half_v", "-1e-3,1,0"))),
       "s.xml:3:2: half_u and half_v are not perpendicular: the cosine between them is -0.001; "
       "allowed: -1e-06 to 1e-06"},
      {scene(emitter("envmap", "")),
       "s.xml:3:2: <emitter type=\"envmap\"> needs the parameter 'filename' (by latitude and "
       "longitude: the top row is +y, the middle column -z, +x to the right of it)"},
      {scene(envmap("sky.exr")),
       "s.xml:3:55: filename 'sky.exr' cannot be looked for: this scene has no directory, it is "
       "not read from a file"},
  };
  for (const auto& [text, message] : bad) EXPECT_EQ(error_of(text), message) << text;
}

TEST(SceneLights, ADirectionIsMadeAUnitVectorOnceAndThenKept) {
  for (int i = 0; i < 30; ++i) {
    std::string body;
    for (int k = 0; k < 64; ++k)
      body += emitter("directional", given("vector", "direction",
                                           fmt::format("{}, {}, {}", i - 7.3, k / 3.7, i * k + 1)));
    const Scene s = again(parse_scene(scene(body), "s.xml"));
    for (const Light& light : s.lights)
      EXPECT_NEAR(length(std::get<DirectionalLight>(light).direction), 1, 1e-15);
  }
}

TEST_F(EnvironmentMap, IsReadFromTheScenesDirectoryAndWrittenByItsName) {
  const Scene s =
      again(parse_scene(scene(emitter("envmap", given("string", "filename", "sky.exr") +
                                                    given("rgb", "radiance", "2, 3, 4.1")) +
                              envmap("./sky.exr") + envmap("below/sky &amp; 'sea'.exr")),
                        "s.xml", directory()),
            directory());
  ASSERT_EQ(s.lights.size(), 3u);
  const auto& first = std::get<EnvmapLight>(s.lights[0]);
  EXPECT_EQ(first.radiance, (Rgb{2, 3, 4.1}));
  EXPECT_EQ(first.file, "sky.exr");
  ASSERT_NE(first.image, nullptr);
  EXPECT_EQ(first.image->width(), 4);
  EXPECT_EQ(first.image->pixel(0, 0)[0], 0.5f);
  EXPECT_EQ(first.image, std::get<EnvmapLight>(s.lights[1]).image) << "it is read once";
  const auto& last = std::get<EnvmapLight>(s.lights[2]);
  EXPECT_EQ(last.file, "below/sky & 'sea'.exr");
  EXPECT_EQ(last.image->pixel(3, 1)[2], 0.25f);
}

TEST_F(EnvironmentMap, IsFoundBesideASceneFileWhereverTheProgramRuns) {
  write_file(directory() / "s.xml", scene(envmap("sky.exr")));
  EXPECT_NE(std::get<EnvmapLight>(read_scene(directory() / "s.xml").lights[0]).image, nullptr);
  const fs::path before = fs::current_path();
  fs::current_path(directory());
  EXPECT_EQ(read_scene("s.xml").lights.size(), 1u);
  fs::current_path(before);
}

TEST_F(EnvironmentMap, NeverComesFromOutsideOfTheScenesDirectory) {
  EXPECT_THAT(error("../private.exr"), HasSubstr("s.xml:3:55: filename '../private.exr' has '..'"));
  EXPECT_THAT(error("below/../../private.exr"), HasSubstr("has '..'"));
  EXPECT_THAT(error("../../etc/passwd"), HasSubstr("has '..'"));
  EXPECT_THAT(error("/etc/passwd"), HasSubstr("is absolute"));
  EXPECT_THAT(error((directory() / "sky.exr").string()), HasSubstr("is absolute"));
  EXPECT_THAT(error(""), HasSubstr("is empty"));
  EXPECT_THAT(error("a&#10;b"), HasSubstr("has control characters"));

  fs::create_symlink("../private.exr", directory() / "link.exr");
  EXPECT_THAT(error("link.exr"), HasSubstr("by a symbolic link"));
  fs::create_directory_symlink("..", directory() / "up");
  EXPECT_THAT(error("up/private.exr"), HasSubstr("by a symbolic link"));
  fs::create_symlink("loop.exr", directory() / "loop.exr");
  EXPECT_THAT(error("loop.exr"), HasSubstr("s.xml:3:55: "));
  fs::create_symlink("sky.exr", directory() / "same.exr");
  EXPECT_EQ(error("same.exr"), "it was read") << "a link that stays inside is none of our business";
}

TEST_F(EnvironmentMap, NeverComesFromOutsideThoughItsFolderIsExchangedMeanwhile) {
  const fs::path evil = directory().parent_path() / "evil";
  fs::create_directories(evil);
  write_exr(evil / "sky.exr", Image(3, 1), {});
  write_exr(directory() / "below" / "sky.exr", sky(1), {});
  fs::create_directory_symlink(evil, directory() / "link");
  std::atomic<bool> done = false;
  std::thread exchange([&] {
    while (!done)
      ::renameat2(AT_FDCWD, (directory() / "below").c_str(), AT_FDCWD,
                  (directory() / "link").c_str(), RENAME_EXCHANGE);
  });
  int reads = 0;
  for (int i = 0; i < 400 && reads < 40; ++i) {
    try {
      const Scene s = parse_scene(scene(envmap("below/sky.exr")), "s.xml", directory());
      EXPECT_EQ(std::get<EnvmapLight>(s.lights.at(0)).image->width(), 4);
      ++reads;
    } catch (const Error&) {  // it was seen
    }
  }
  done = true;
  exchange.join();
}

TEST_F(EnvironmentMap, MustBeAPicture) {
  write_file(directory() / "text.exr", std::string_view("no picture"));
  EXPECT_THAT(error("text.exr"), HasSubstr("text.exr: not a readable picture"));
  EXPECT_THAT(error("none.exr"), HasSubstr("none.exr: cannot read: No such file or directory"));
  EXPECT_THAT(error("below"), HasSubstr("below: not a regular file"));
  EXPECT_THAT(error("."), HasSubstr("not a regular file"));
  EXPECT_THAT(error(std::string(100000, 'a')), HasSubstr("s.xml:3:55: "));
}

TEST_F(EnvironmentMap, HasNoValueThatIsNoRadiance) {
  for (const auto& [value, word] :
       std::vector<std::pair<float, std::string>>{{std::nanf(""), "nan"},
                                                  {std::numeric_limits<float>::infinity(), "inf"},
                                                  {-1e-6f, "-1e-06"},
                                                  {2e9f, "2000000000"}}) {
    Image image = sky(1);
    image.pixel(2, 1)[1] = value;
    write_exr(directory() / "bad.exr", image, {});
    EXPECT_EQ(error("bad.exr"), "s.xml:3:55: filename 'bad.exr' has the value " + word +
                                    " in pixel (2, 1); allowed: 0 to 1e+09");
  }
}

TEST_F(EnvironmentMap, IsDecodedWhereAFileIsMadeForTheDisplay) {
  write_png(directory() / "sky.png", {1, 1, {255, 0, 128}});
  const Scene s = parse_scene(scene(envmap("sky.png")), "s.xml", directory());
  const auto pixel = std::get<EnvmapLight>(s.lights[0]).image->pixel(0, 0);
  EXPECT_NEAR(pixel[0], 1, 1e-6);
  EXPECT_NEAR(pixel[2], 0.21586, 1e-4);  // sRGB 128 of 255
}

}  // namespace
}  // namespace lobelia
