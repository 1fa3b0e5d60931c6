// Pictures for better displays: JPEGs with gain maps, made byte by byte, and PNGs with PQ and HLG.
#include "core/gain_map.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "core/colour.hpp"
#include "core/image_io.hpp"
#include "tests/core/picture_fixture.hpp"

namespace lobelia {
namespace {

using namespace fixtures;
using ::testing::HasSubstr;

using Bytes = std::vector<std::uint8_t>;

/// The numbers of a gain map, one or three of each.
struct Numbers {
  std::vector<double> min{0}, max{2}, gamma{1}, offset_sdr{1.0 / 64}, offset_hdr{1.0 / 64};
  double at(const std::vector<double>& values, std::size_t c) const {
    return values.size() == 1 ? values[0] : values[c];
  }
  /// Adobe's formula, for linear light and a value of the map from 0 to 1.
  double hdr(double light, double value, std::size_t c) const {
    const double share = std::pow(value, 1 / at(gamma, c));
    const double boost = at(min, c) * (1 - share) + at(max, c) * share;
    return (light + at(offset_sdr, c)) * std::pow(2, boost) - at(offset_hdr, c);
  }
};

std::string xmp_of(const Numbers& numbers, const std::string& more = "") {
  std::string attributes, elements;
  const auto add = [&](const char* name, const std::vector<double>& values) {
    if (values.size() == 1) {
      attributes += fmt::format("hdrgm:{}='{}' ", name, values[0]);
      return;
    }
    elements += fmt::format("<hdrgm:{}><rdf:Seq>", name);
    for (const double value : values) elements += fmt::format("<rdf:li>{}</rdf:li>", value);
    elements += fmt::format("</rdf:Seq></hdrgm:{}>", name);
  };
  add("GainMapMin", numbers.min);
  add("GainMapMax", numbers.max);
  add("Gamma", numbers.gamma);
  add("OffsetSDR", numbers.offset_sdr);
  add("OffsetHDR", numbers.offset_hdr);
  return xmp_segment(attributes + "hdrgm:HDRCapacityMin='0' hdrgm:HDRCapacityMax='2' " + more +
                     ">" + elements);
}

/// ISO 21496-1: fractions with one denominator.
std::string iso_of(const Numbers& numbers) {
  const std::uint32_t denominator = 1 << 20;
  const auto put = [&](double value) {
    return big_endian(std::uint32_t(std::int32_t(std::lround(value * denominator))));
  };
  const std::size_t channels = numbers.max.size();
  std::string data = std::string(4, '\0') + char((channels == 3 ? 0x80 : 0) | 0x40 | 8) +
                     big_endian(denominator) + put(0) + put(2);
  for (std::size_t c = 0; c < channels; ++c)
    for (const auto* values :
         {&numbers.min, &numbers.max, &numbers.gamma, &numbers.offset_sdr, &numbers.offset_hdr})
      data += put(numbers.at(*values, c));
  return jpeg_segment(0xe2, std::string("urn:iso:std:iso:ts:21496:-1\0", 28) + data);
}

class GainMaps : public PictureFiles {
 protected:
  Picture read(const std::string& bytes) { return read_picture(file("a.jpg", bytes), ""); }
  void TearDown() override { read_base_pictures(false); }
  /// Two blocks of eight pixels each way.
  const std::string base_ = block_jpeg(2, 2, 3,
                                       Bytes{200, 150, 90, 10, 20, 30,  //
                                             255, 255, 255, 0, 0, 0});
};

TEST_F(GainMaps, BrightenAllChannelsByAdobesFormula) {
  Numbers numbers;
  numbers.min = {-0.5};
  numbers.max = {3};
  numbers.gamma = {1.4};
  const std::string map = with_segments(block_jpeg(1, 1, 1, {180}), xmp_of(numbers));
  const Picture picture = read(ultra_hdr(base_, map));
  EXPECT_EQ(picture.source.gain_map, "applied");
  const std::uint8_t codes[] = {200, 150, 90};
  for (std::size_t c = 0; c < 3; ++c) {
    const double light = double(srgb_decoded(float(codes[c]) / 255));
    EXPECT_NEAR(picture.image.pixel(3, 3)[c], numbers.hdr(light, 180 / 255.0, c), 1e-5);
    EXPECT_NEAR(picture.image.pixel(3, 12)[c], numbers.hdr(1, 180 / 255.0, c), 1e-5);
  }
}

TEST_F(GainMaps, AreInterpolatedInThreeChannelsBetweenTheirPixels) {
  Numbers numbers;
  numbers.min = {-1, 0, 0.25};
  numbers.max = {1, 2, 3};
  numbers.gamma = {1, 0.5, 2};
  numbers.offset_sdr = {0, 0.125, 0.25};
  numbers.offset_hdr = {0.5, 0, 0.0625};
  // As large as the base picture: two columns of blocks.
  const std::string map =
      with_segments(block_jpeg(2, 1, 3, Bytes{40, 80, 120, 240, 160, 200}), xmp_of(numbers));
  const std::string white = block_jpeg(4, 4, 3, Bytes(48, 255));
  const Picture picture = read(ultra_hdr(white, map));
  ASSERT_EQ(picture.image.width(), 32);
  const double left[] = {40, 80, 120}, right[] = {240, 160, 200};
  for (int x = 0; x < 32; ++x) {
    // The map has half as many pixels a row; its value steps between its pixels 7 and 8.
    const double place = (x + 0.5) / 2 - 0.5, share = std::clamp(place - 7, 0.0, 1.0);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(picture.image.pixel(x, 17)[c],
                  numbers.hdr(1, (left[c] + (right[c] - left[c]) * share) / 255, c), 1e-5)
          << x;
  }
}

TEST_F(GainMaps, AreTheSameInTheFormOfIso21496) {
  Numbers numbers;
  numbers.min = {-1, 0, 0.25};
  numbers.max = {1, 2, 3};
  numbers.gamma = {1, 0.5, 2};
  const std::string map = block_jpeg(1, 1, 3, {30, 90, 250});
  const Picture xmp = read(ultra_hdr(base_, with_segments(map, xmp_of(numbers)))),
                iso = read(ultra_hdr(base_, with_segments(map, iso_of(numbers)),
                                     jpeg_segment(0xe2, std::string("urn:iso:std:iso:ts:21496:-1\0"
                                                                    "\0\0\0\0",
                                                                    32))));
  for (std::size_t i = 0; i < xmp.image.values().size(); ++i)
    ASSERT_NEAR(iso.image.values()[i], xmp.image.values()[i], 1e-5);
}

TEST_F(GainMaps, WorkInThePrimariesOfTheBasePicture) {
  // One channel twice as bright, in primaries that are a rotation of ours.
  const RgbMatrix rotated{{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}};
  GainMap gain;
  gain.max = {0, 1, 0};
  Image map(1, 1), light(1, 1);
  std::ranges::fill(map.values(), 1.0f);
  std::ranges::copy(std::array{0.25f, 0.5f, 0.75f}, light.values().begin());
  apply_gain(gain, map, rotated, light);
  // Our red is its green.
  EXPECT_THAT(values(light), ::testing::ElementsAre(0.5f, 0.5f, 0.75f));
}

TEST_F(GainMaps, AreLeftOutIfAskedOrIfTheBaseIsTheHdrPicture) {
  const Picture plain = read(base_);
  EXPECT_EQ(plain.source.gain_map, "");
  const std::string map = block_jpeg(1, 1, 1, {180});
  const Picture hdr_base =
      read(ultra_hdr(base_, with_segments(map, xmp_of({}, "hdrgm:BaseRenditionIsHDR='True'"))));
  EXPECT_EQ(hdr_base.source.gain_map, "for SDR");
  EXPECT_EQ(values(hdr_base.image), values(plain.image));
  read_base_pictures();
  const Picture left_out = read(ultra_hdr(base_, with_segments(map, xmp_of({}))));
  EXPECT_EQ(left_out.source.gain_map, "left out");
  EXPECT_EQ(values(left_out.image), values(plain.image));
}

TEST_F(GainMaps, AreAnErrorOfThePictureIfMissingOrImpossible) {
  const std::string map = with_segments(block_jpeg(1, 1, 1, {180}), xmp_of({}));
  const auto bad = [&](const std::string& bytes) { return refusal(file("b.jpg", bytes)); };
  EXPECT_THAT(bad(ultra_hdr(base_, map, xmp_segment(">"), 1 << 30)),
              HasSubstr("which is not there"));
  EXPECT_THAT(bad(ultra_hdr(base_, map, xmp_segment(">"), 7)), HasSubstr("which is not there"));
  EXPECT_THAT(bad(with_segments(base_, xmp_segment(">"))), HasSubstr("--base-only"));
  for (const char* more : {"-100", "1e9"}) {
    Numbers numbers;
    numbers.max = {std::stod(more)};
    EXPECT_THAT(bad(ultra_hdr(base_, with_segments(block_jpeg(1, 1, 1, {9}), xmp_of(numbers)))),
                HasSubstr("are impossible"));
  }
  const std::string cut = map.substr(0, map.size() - 2);
  EXPECT_THAT(bad(ultra_hdr(base_, cut)), HasSubstr("cut off"));
  // ISO's numbers: zero denominators.
  std::string iso = iso_of({});
  for (std::size_t i = 37; i < 41; ++i) iso[i] = '\0';
  EXPECT_THAT(bad(ultra_hdr(base_, with_segments(block_jpeg(1, 1, 1, {9}), iso))),
              HasSubstr("are impossible"));
}

class HdrCurves : public PictureFiles {
 protected:
  /// Light of a PNG of 16 bits with these RGB codes from 0 to 1.
  Image read(int transfer, int primaries, const std::vector<double>& codes) {
    std::string samples;
    for (const double code : codes)
      samples += big_endian(std::uint32_t(std::lround(code * 65535)), 2);
    const Picture picture = read_picture(
        file("a.png",
             png_file({.width = std::uint32_t(codes.size() / 3),
                       .bits = 16,
                       .samples = samples,
                       .chunks = png_chunk("cICP", {char(primaries), char(transfer), 0, 1})})),
        "");
    EXPECT_EQ(picture.source.transfer, transfer == 16 ? "PQ" : "HLG");
    return picture.image;
  }
};

TEST_F(HdrCurves, DecodePqToLightWith1For203CandelaPerSquareMetre) {
  // Codes of ITU-R BT.2100's inverse EOTF, published with ITU-R BT.2408 in per cent.
  for (const auto& [code, nits] : {std::pair{0.0, 0.0},
                                   {0.149945, 1.0},
                                   {0.508078, 100.0},
                                   {0.580689, 203.0},
                                   {0.751827, 1000.0},
                                   {1.0, 10000.0}}) {
    const Image image = read(16, 1, {code, code, code});
    EXPECT_NEAR(image.pixel(0, 0)[1], nits / 203, 2e-4 * nits / 203 + 1e-9) << code;
  }
}

TEST_F(HdrCurves, DecodeHlgToTheLightOfItsNominalDisplay) {
  // ITU-R BT.2408, table 1: 75 % is the white of 203 cd/m^2, 100 % the peak of 1000, 38 % the grey card of 26.
  for (const auto& [code, nits, by] :
       {std::tuple{0.75, 203.0, 0.3}, {1.0, 1000.0, 0.01}, {0.38, 26.0, 0.6}, {0.0, 0.0, 1e-9}})
    EXPECT_NEAR(203 * double(read(18, 9, {code, code, code}).pixel(0, 0)[1]), nits, by) << code;
  // A colour: the OOTF of ITU-R BT.2100 by the luminance of Rec. 2020.
  const double scene[] = {0.25 / 3, 0.04 / 3, 0.01 / 3};
  const double y = 0.2627 * scene[0] + 0.6780 * scene[1] + 0.0593 * scene[2];
  Image expected(1, 1);
  for (std::size_t c = 0; c < 3; ++c)
    expected.values()[c] = float(1000 / 203.0 * std::pow(y, 0.2) * scene[c]);
  lobelia::apply(*to_rec709(*chromaticities_of_code_point(9)), expected);
  const Image image = read(18, 9, {0.5, 0.2, 0.1});
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(image.values()[c], expected.values()[c], 1e-4 * expected.values()[0]);
}

}  // namespace
}  // namespace lobelia
