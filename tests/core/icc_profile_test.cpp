// Profiles made byte by byte (ICC.1:2022), and one in a JPEG.
#include "core/picture_colour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/image_io.hpp"
#include "tests/core/picture_files.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

std::string fixed(double value) { return big_endian(std::uint32_t(std::lround(value * 65536))); }

std::string xyz(double x, double y, double z) {
  return std::string("XYZ \0\0\0\0", 8) + fixed(x) + fixed(y) + fixed(z);
}

/// A parametric curve of type 3, as sRGB's.
std::string parametric(double gamma) {
  return std::string("para\0\0\0\0\0\3\0\0", 12) + fixed(gamma) + fixed(1 / 1.055) +
         fixed(0.055 / 1.055) + fixed(1 / 12.92) + fixed(0.04045);
}

/// A table of `size` entries of value^gamma, or of sRGB with gamma 0.
std::string table(int size, double gamma) {
  std::string text = std::string("curv\0\0\0\0", 8) + big_endian(std::uint32_t(size));
  for (int i = 0; i < size; ++i) {
    const double v = double(i) / (size - 1);
    const double light = gamma > 0      ? std::pow(v, gamma)
                         : v <= 0.04045 ? v / 12.92
                                        : std::pow((v + 0.055) / 1.055, 2.4);
    text += big_endian(std::uint32_t(std::lround(65535 * light)), 2);
  }
  return text;
}

/// One entry of value * 256: value^gamma.
std::string power(double gamma) {
  return std::string("curv\0\0\0\0\0\0\0\1", 12) +
         big_endian(std::uint32_t(std::lround(gamma * 256)), 2) + std::string(2, '\0');
}

const std::string kSrgbRed = xyz(0.43607, 0.22249, 0.01392);

std::string profile(const std::string& curve, const std::string& red = kSrgbRed) {
  const std::vector<std::pair<std::string, std::string>> tags = {
      {"rXYZ", red},   {"gXYZ", xyz(0.38515, 0.71687, 0.09708)},
      {"rTRC", curve}, {"bXYZ", xyz(0.14307, 0.06061, 0.71410)},
      {"gTRC", curve}, {"bTRC", curve}};
  std::string table = big_endian(std::uint32_t(tags.size())), data;
  const std::size_t start = 128 + 4 + 12 * tags.size();
  for (const auto& [name, bytes] : tags) {
    table += name + big_endian(std::uint32_t(start + data.size())) +
             big_endian(std::uint32_t(bytes.size()));
    data += bytes;
  }
  std::string header(128, '\0');
  header.replace(0, 4, big_endian(std::uint32_t(start + data.size())));
  header.replace(8, 4, std::string("\4\x30\0\0", 4));
  header.replace(12, 12, "mntrRGB XYZ ");
  header.replace(36, 4, "acsp");
  return header + table + data;
}

bool is_srgb(const std::string& bytes) { return is_srgb_profile(bytes); }

TEST(IccProfile, OfSrgbIsKnownByItsColoursAndCurves) {
  EXPECT_TRUE(is_srgb(profile(parametric(2.4))));
  EXPECT_TRUE(is_srgb(profile(table(1024, 0))));
  EXPECT_TRUE(is_srgb(profile(table(4096, 0))));
  EXPECT_FALSE(is_srgb(profile(power(2.2)))) << "of Adobe's gamma";
  EXPECT_FALSE(is_srgb(profile(table(1024, 1.8))));
  EXPECT_FALSE(is_srgb(profile(std::string("curv\0\0\0\0\0\0\0\0", 12)))) << "linear";
  // Adobe RGB (1998), Display P3: red at D50.
  EXPECT_FALSE(is_srgb(profile(parametric(2.4), xyz(0.60974, 0.31111, 0.01947))));
  EXPECT_FALSE(is_srgb(profile(parametric(2.4), xyz(0.51512, 0.24120, -0.00105))));
}

TEST(IccProfile, ThatIsDamagedIsReadWithoutHarmAndIsNotSrgbWhenItIsCut) {
  const std::string good = profile(table(256, 0));
  for (std::size_t length = 0; length < good.size(); ++length)
    EXPECT_FALSE(is_srgb(good.substr(0, length))) << length;
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    std::string bad = good;
    for (int k = 0; k < 4; ++k) bad[random() % bad.size()] = char(random());
    is_srgb(bad);
  }
}

TEST(IccProfile, OfAPictureIsNamedAndSaidToBeSrgbOrNot) {
  const TemporaryDirectory directory;
  const std::string jpeg = grey_jpeg_file(3);
  const auto read_with = [&](const std::string& bytes) {
    const std::string data = std::string("ICC_PROFILE\0\1\1", 14) + bytes;
    write_file(directory.path() / "a.jpg", jpeg.substr(0, 2) + "\xff\xe2" +
                                               big_endian(std::uint32_t(data.size() + 2), 2) +
                                               data + jpeg.substr(2));
    return read_picture(directory.path() / "a.jpg", "").source;
  };
  const PictureSource srgb = read_with(profile(parametric(2.4)));
  EXPECT_NE(srgb.icc_profile, "");
  EXPECT_TRUE(srgb.icc_is_srgb);
  const PictureSource other = read_with(profile(power(2.2)));
  EXPECT_NE(other.icc_profile, "");
  EXPECT_FALSE(other.icc_is_srgb);
}

}  // namespace
}  // namespace lobelia
