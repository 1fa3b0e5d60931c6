// Float pictures as text: what is read back is what was written, to the bits that were kept.
#include "gallery/packed/half_picture.hpp"

#include <zlib.h>

#include "tests/gallery/site.hpp"
#include "tests/test.hpp"

namespace lobelia::gallery {
namespace {

/// The reader of gallery/web/src/half_picture.ts, written again.
std::vector<double> decoded(const records::PackedPicture& picture) {
  const std::size_t width = picture.width, pixels = width * picture.height;
  std::string bytes(6 * pixels, '\0');
  const std::string packed = from_base64(picture.planes);
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  EXPECT_EQ(size, bytes.size());
  std::vector<double> values(3 * pixels);
  std::vector<int> before(pixels), plane(pixels);
  for (int channel = 0; channel < 3; ++channel) {
    const auto* low = reinterpret_cast<const unsigned char*>(bytes.data()) + 2 * pixels * channel;
    for (std::size_t i = 0; i < pixels; ++i) {
      const bool column0 = i % width == 0, row0 = i < width;
      const int left = column0 ? (row0 ? 0 : plane[i - width]) : plane[i - 1];
      const int above = row0 ? left : plane[i - width];
      const int corner = column0 || row0 ? left : plane[i - width - 1];
      const int guess = !picture.predicted                ? 0
                        : corner >= std::max(left, above) ? std::min(left, above)
                        : corner <= std::min(left, above) ? std::max(left, above)
                                                          : left + above - corner;
      const int code = low[i] | low[pixels + i] << 8;
      plane[i] = static_cast<std::int16_t>(guess + (code >> 1 ^ -(code & 1)));
      const auto number = static_cast<std::int16_t>(plane[i] + (channel ? before[i] : 0));
      before[i] = number;
      const int magnitude = std::abs(number) << (10 - picture.mantissa_bits);
      double value = magnitude < 0x400
                         ? std::ldexp(magnitude, -24)
                         : std::ldexp(1024 + (magnitude & 0x3ff), (magnitude >> 10) - 25);
      if (magnitude >= 0x7c00) value = magnitude == 0x7c00 ? HUGE_VAL : NAN;
      values[3 * i + channel] = std::ldexp(number < 0 ? -value : value, -picture.scale_log2);
    }
  }
  return values;
}

Image noise(int width, int height, double decades) {
  Image image(width, height);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-decades, 0), side(-1, 1);
  for (float& value : image.values())
    value = static_cast<float>(std::copysign(std::pow(10, exponent(random)), side(random)));
  return image;
}

TEST(HalfPicture, KeepsEveryValueToTheBitsOfItsMantissa) {
  const Image image = noise(37, 23, 3);
  for (int precision = 1; precision <= kFinest; ++precision) {
    const std::vector<double> values = decoded(half_picture(image, precision));
    double largest = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      largest = std::max(largest, std::abs(values[i] / image.values()[i] - 1));
    // Rounded twice, to a half float and to fewer bits: a little over half a unit of the last.
    EXPECT_LE(largest, std::ldexp(0.5, -precision) *
                           (precision < 10 ? 1 + std::ldexp(1, precision - 10) : 1))
        << precision;
    EXPECT_GE(largest, std::ldexp(0.2, -precision)) << precision << ": more bits than it says";
  }
}

TEST(HalfPicture, HasItsLargestValueInRangeHoweverBrightOrDarkItIs) {
  for (const float factor : {1e-30f, 1e-6f, 1.0f, 163.0f, 2e5f, 1e30f}) {
    Image image = noise(8, 8, 1);
    for (float& value : image.values()) value *= factor;
    const std::vector<double> values = decoded(half_picture(image, kFinest));
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i] / image.values()[i], 1, 5e-4) << factor;
  }
}

TEST(HalfPicture, KeepsNonfiniteValues) {
  Image image = noise(5, 4, 2);
  image.pixel(1, 1)[0] = std::numeric_limits<float>::infinity();
  image.pixel(2, 1)[1] = -std::numeric_limits<float>::infinity();
  image.pixel(3, 2)[2] = std::numeric_limits<float>::quiet_NaN();
  for (const int precision : {kFinest, 4, 1, kCoarsest}) {
    const auto values = decoded(half_picture(image, precision));
    EXPECT_EQ(values[3 * 6], HUGE_VAL) << precision;
    EXPECT_EQ(values[3 * 7 + 1], -HUGE_VAL) << precision;
    EXPECT_TRUE(std::isnan(values[3 * 13 + 2])) << precision;
    for (const std::size_t i : {0, 1, 2, 19, 20, 59})
      EXPECT_TRUE(std::isfinite(values[i])) << precision << " " << i;
  }
}

TEST(HalfPicture, OmitsValuesBelowItsLeast) {
  const Image image = noise(64, 64, 6);
  const records::PackedPicture coarse = half_picture(image, -2);
  EXPECT_NEAR(coarse.least, std::ldexp(1, -10), 2e-5);
  const auto values = decoded(coarse);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_EQ(values[i] == 0, std::abs(image.values()[i]) < coarse.least) << i;
  EXPECT_EQ(half_picture(image, 1).least, 0);
}

TEST(HalfPicture, IsShorterIfCoarserOrSmoother) {
  const Image rough = noise(128, 128, 5);
  std::size_t before = half_picture(rough, kFinest).planes.size();
  for (int precision = kFinest - 1; precision >= kCoarsest; --precision) {
    const std::size_t size = half_picture(rough, precision).planes.size();
    EXPECT_LT(double(size), 1.05 * double(before)) << precision;
    before = size;
  }
  EXPECT_LT(4 * before, half_picture(rough, kFinest).planes.size());
  Image smooth(128, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      for (float& value : smooth.pixel(x, y))
        value = static_cast<float>(std::exp(-(x * x + y * y) / 3000.0));
  EXPECT_LT(half_picture(smooth, kFinest).planes.size() * 6,
            half_picture(rough, kFinest).planes.size());
}

}  // namespace
}  // namespace lobelia::gallery
