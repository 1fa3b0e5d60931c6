// Pictures for better displays: JPEGs with gain maps, made byte by byte, and PNGs with PQ and HLG.
#include "base/pictures/image_io.hpp"
#include "base/pictures/picture_colour.hpp"
#include "tests/base/picture_fixture.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;
using Bytes = std::vector<std::uint8_t>;

using GainMaps = PictureFiles;

TEST_F(GainMaps, AreNamedAndNotApplied) {
  const std::string base = block_jpeg(2, 2, 3,
                                      Bytes{200, 150, 90, 10, 20, 30,  //
                                            255, 255, 255, 0, 0, 0});
  const auto read = [&](const std::string& bytes) {
    return read_picture(file("a.jpg", bytes), "");
  };
  const Picture plain = read(base);
  EXPECT_FALSE(plain.source.has_gain_map);
  for (const std::string& segment :
       {gain_map_segment(), jpeg_segment(0xe2, std::string("urn:iso:std:iso:ts:21496:-1\0"
                                                           "\0\0\0\0",
                                                           32))}) {
    const Picture picture = read(with_segments(base, segment));
    EXPECT_TRUE(picture.source.has_gain_map);
    EXPECT_EQ(values(picture.image), values(plain.image));
  }
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
