// EXRs of luminance and chroma beside OpenEXR's own reader, and beside the picture that they were made of.
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>

#include "base/pictures/picture_light.hpp"
#include "tests/base/picture_fixture.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

const Imf::Chromaticities kXyzOfOpenExr({1, 0}, {0, 1}, {0, 0}, {1 / 3.0f, 1 / 3.0f});

class LuminanceChroma : public PictureFiles {
 protected:
  /// Smooth, so that chroma of every second pixel says it all.
  std::vector<Imf::Rgba> smooth(int width, int height) {
    std::uniform_real_distribution<float> any(0.2f, 1);
    const float a = any(random_), b = any(random_), c = any(random_);
    std::vector<Imf::Rgba> pixels;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const float s = 1 + 0.5f * std::sin(0.1f * float(x) + 0.05f * float(y) + a);
        pixels.emplace_back(a * s, b * (1 + s) / 2, c * (2 - s / 2), 0.5f);
      }
    return pixels;
  }
  std::filesystem::path write(const std::string& name, const Imf::Header& header,
                              Imf::RgbaChannels channels, const std::vector<Imf::Rgba>& pixels) {
    const auto path = directory_.path() / name;
    Imf::RgbaOutputFile output(path.c_str(), header, channels);
    output.setYCRounding(10, 10);  // all of a half
    const Imath::Box2i box = header.dataWindow();
    const int width = box.max.x - box.min.x + 1;
    output.setFrameBuffer(Imf::ComputeBasePointer(pixels.data(), box), 1, std::size_t(width));
    output.writePixels(box.max.y - box.min.y + 1);
    return path;
  }
  static std::vector<float> by_openexr(const std::filesystem::path& path) {
    Imf::RgbaInputFile input(path.c_str());
    const Imath::Box2i box = input.dataWindow();
    const int width = box.max.x - box.min.x + 1, height = box.max.y - box.min.y + 1;
    std::vector<Imf::Rgba> pixels(std::size_t(width) * std::size_t(height));
    input.setFrameBuffer(Imf::ComputeBasePointer(pixels.data(), box), 1, std::size_t(width));
    input.readPixels(box.min.y, box.max.y);
    std::vector<float> result;
    for (const Imf::Rgba& pixel : pixels)
      for (const half value : {pixel.r, pixel.g, pixel.b}) result.push_back(value);
    return result;
  }
  std::mt19937 random_{11};
};

TEST_F(LuminanceChroma, MatchesOpenExr) {
  for (int i = 0; i < 12; ++i) {
    std::uniform_int_distribution<int> half_side(1, 40), corner(-5, 5);
    const int width = 2 * half_side(random_), height = 2 * half_side(random_);
    const Imath::Box2i box = window(2 * corner(random_), 2 * corner(random_), width, height);
    Imf::Header header(box, box);
    header.lineOrder() = i % 2 == 0 ? Imf::INCREASING_Y : Imf::DECREASING_Y;
    header.compression() = i % 3 == 0 ? Imf::PIZ_COMPRESSION : Imf::ZIP_COMPRESSION;
    std::vector<Imf::Rgba> pixels = smooth(width, height);
    std::uniform_real_distribution<float> any(0, 3);
    for (Imf::Rgba& pixel : pixels)
      if (i % 4 == 0) pixel = {any(random_), any(random_), any(random_), 1};
    const auto path = write("yc.exr", header, i % 2 == 0 ? Imf::WRITE_YC : Imf::WRITE_YCA, pixels);
    const Picture picture = read_picture(path, "");
    EXPECT_EQ(values(picture.image), by_openexr(path));
    EXPECT_THAT(picture.source.channels, ElementsAre("Y", "RY", "BY"));
    EXPECT_EQ(picture.source.value_type, "half");
    EXPECT_EQ(picture.source.alpha, i % 2 == 0 ? "" : "A");
  }
}

TEST_F(LuminanceChroma, ShowsThePictureThatItWasMadeOf) {
  constexpr int kWidth = 64, kHeight = 48;
  const std::vector<Imf::Rgba> pixels = smooth(kWidth, kHeight);
  Imf::Header header(kWidth, kHeight);
  const Image expected = read_image(write("rgb.exr", header, Imf::WRITE_RGB, pixels));
  const Image yc = read_image(write("yc.exr", header, Imf::WRITE_YC, pixels));
  // The same light as X, Y and Z.
  const RgbMatrix to_rgb = to_rec709(kXyzChromaticities).value(), to_xyz = inverse(to_rgb);
  std::vector<Imf::Rgba> xyz;
  for (const Imf::Rgba& p : pixels) {
    const auto row = [&](std::size_t i) {
      return half(float(to_xyz[i][0] * double(p.r) + to_xyz[i][1] * double(p.g) +
                        to_xyz[i][2] * double(p.b)));
    };
    xyz.emplace_back(row(0), row(1), row(2), half(1));
  }
  Imf::addChromaticities(header, kXyzOfOpenExr);
  const Image from_xyz = read_image(write("xyz.exr", header, Imf::WRITE_RGB, xyz));
  const Image from_xyz_yc = read_image(write("xyz_yc.exr", header, Imf::WRITE_YC, xyz));
  // The chroma at the border is filled in from one side.
  constexpr int kBorder = 14;
  for (int y = kBorder; y < kHeight - kBorder; ++y)
    for (int x = kBorder; x < kWidth - kBorder; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const float truth = expected.pixel(x, y)[c];
        EXPECT_NEAR(yc.pixel(x, y)[c], truth, 0.01f * truth);
        EXPECT_NEAR(from_xyz.pixel(x, y)[c], truth, 0.005f * truth);
        EXPECT_NEAR(from_xyz_yc.pixel(x, y)[c], truth, 0.02f * truth);
      }
}

TEST_F(LuminanceChroma, IsCutToTheDisplayWindow) {
  Imf::Header header(window(0, 0, 6, 4), window(-2, 0, 10, 8));
  const auto path = write("data.exr", header, Imf::WRITE_YC, smooth(10, 8));
  const Picture picture = read_picture(path, "");
  const std::vector<float> all = by_openexr(path);
  ASSERT_EQ(picture.image.width(), 6);
  ASSERT_EQ(picture.image.height(), 4);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_EQ(picture.image.pixel(5, 3)[c], all[3 * (3 * 10 + 7) + c]);
  EXPECT_EQ(values(picture.overscan), all);
}

TEST_F(LuminanceChroma, HasLayersOfItsAlphaAndItsLuminance) {
  const Imf::Header header(4, 2);
  const auto path = write("yca.exr", header, Imf::WRITE_YCA, smooth(4, 2));
  EXPECT_THAT(layer_names(path), ElementsAre("", "A"));
  EXPECT_THAT(values(read_picture(path, "A").image), ::testing::Each(0.5f));
  const Picture y = read_picture(path, "Y");
  EXPECT_EQ(y.image.pixel(1, 1)[0], y.image.pixel(1, 1)[2]);
  EXPECT_THAT(refusal(path, "RY"), HasSubstr("its channel RY has one value for 2 x 2 pixels"));
}

TEST_F(LuminanceChroma, IsRefusedIfItIsCutOff) {
  const Imf::Header header(32, 32);
  const std::string whole =
      read_file(write("whole.exr", header, Imf::WRITE_YC, smooth(32, 32)), 1 << 20);
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 8)
    EXPECT_THAT(refusal(file("cut.exr", whole.substr(0, size))), HasSubstr(": "));
}

TEST_F(LuminanceChroma, MixesEveryPixelInFloats) {
  const auto weights = luminance_weights(kRec709Chromaticities);
  std::uniform_real_distribution<double> any(0.1, 9);
  std::vector<float> y, ry, by;
  std::vector<double> rgb;
  for (int i = 0; i < 20; ++i) {
    const double r = any(random_), g = any(random_), b = any(random_);
    const double light = weights[0] * r + weights[1] * g + weights[2] * b;
    rgb.insert(rgb.end(), {r, g, b});
    y.push_back(float(light));
    ry.push_back(float((r - light) / light));
    by.push_back(float((b - light) / light));
  }
  const Picture picture =
      read_picture(exr("full.exr", 20, 1, {{"Y", y}, {"RY", ry}, {"BY", by}}), "");
  EXPECT_THAT(picture.source.channels, ElementsAre("Y", "RY", "BY"));
  for (std::size_t i = 0; i < rgb.size(); ++i)
    EXPECT_NEAR(double(picture.image.values()[i]), rgb[i], 1e-4);
}

}  // namespace
}  // namespace lobelia
