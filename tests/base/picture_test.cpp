// The meaning of a file's values, by files made for that.
#include <ImfEnvmap.h>
#include <ImfTiledOutputFile.h>

#include "base/pictures/image_io.hpp"
#include "base/pictures/picture.hpp"
#include "tests/base/picture_files.hpp"
#include "tests/base/picture_fixture.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

const double kMiddle = 0.2158605;  // sRGB's 128 of 255 as light, IEC 61966-2-1

using Layers = PictureFiles;

TEST_F(Layers, AreReadByNameFromAnExr) {
  const auto path = exr("a.exr", 1, 1,
                        {{"R", {1}},
                         {"G", {2}},
                         {"B", {3}},
                         {"A", {0.5f}},
                         {"Z", {70}},
                         {"diffuse.R", {4}},
                         {"diffuse.G", {5}},
                         {"diffuse.B", {6}}});
  EXPECT_THAT(layer_names(path), ::testing::UnorderedElementsAre("", "A", "Z", "diffuse"));
  EXPECT_THAT(values(read_image(path)), ElementsAre(1, 2, 3)) << "not multiplied by A again";
  EXPECT_THAT(values(read_picture(path, "diffuse").image), ElementsAre(4, 5, 6));
  EXPECT_THAT(values(read_picture(path, "Z").image), ElementsAre(70, 70, 70));
  EXPECT_THAT(values(read_picture(path, "A").image), ElementsAre(0.5f, 0.5f, 0.5f));
  EXPECT_THAT(values(read_picture(path, "diffuse.G").image), ElementsAre(5, 5, 5));
  EXPECT_THAT(refusal(path, "difuse"), HasSubstr("did you mean 'diffuse'?"));
}

TEST_F(Layers, AreReadWholeWhereTheirChannelsLieApart) {
  // OpenImageIO brings R, G, B of a prefix together; of the words it knows no order.
  const auto path = exr("a.exr", 2, 2,
                        {{"x.Blue", {3, 6, 9, 12}},
                         {"x.Depth", {0, 0, 0, 0}},
                         {"x.Green", {2, 5, 8, 11}},
                         {"x.Other", {0, 0, 0, 0}},
                         {"x.Red", {1, 4, 7, 10}}});
  EXPECT_THAT(values(read_image(path)), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
}

TEST_F(Layers, AreReadFromTheirPart) {
  const auto box = window(0, 0, 2, 1), narrow = window(1, 0, 1, 1);
  const auto path =
      exr("a.exr", {{"beauty", box, box, {{"R", {1, 4}}, {"G", {2, 5}}, {"B", {3, 6}}}},
                    {"diffuse", narrow, box, {{"R", {7}}, {"G", {8}}, {"B", {9}}}},
                    {"depth", box, box, {{"Z", {70, 80}}}}});
  EXPECT_THAT(layer_names(path), ElementsAre("", "diffuse", "depth.Z"));
  EXPECT_THAT(values(read_image(path)), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(values(read_picture(path, "diffuse").image), ElementsAre(0, 0, 0, 7, 8, 9));
  EXPECT_THAT(values(read_picture(path, "depth").image), ElementsAre(70, 70, 70, 80, 80, 80));
}

using Windows = PictureFiles;

TEST_F(Windows, LeaveBlackWhereNoDataAreAndCutOffTheRest) {
  // Data on (1, 1) to (3, 2), of a display on (-1, 0) to (2, 3).
  const auto path =
      exr("a.exr", {{"", window(1, 1, 3, 2), window(-1, 0, 4, 4), {{"Y", {1, 2, 3, 4, 5, 6}}}}});
  const Picture picture = read_picture(path, "");
  EXPECT_EQ(picture.source.data, (PixelWindow{1, 1, 3, 2}));
  EXPECT_EQ(picture.source.display, (PixelWindow{-1, 0, 4, 4}));
  std::vector<float> grey;
  for (std::size_t i = 0; i < picture.image.values().size(); i += 3)
    grey.push_back(picture.image.values()[i]);
  EXPECT_THAT(grey, ElementsAre(0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 4, 5, 0, 0, 0, 0));
  ASSERT_EQ(picture.overscan.width(), 3) << "what lies outside comes whole, by itself";
  ASSERT_EQ(picture.overscan.height(), 2);
  EXPECT_EQ(picture.overscan.pixel(2, 1)[2], 6);
  EXPECT_EQ(read_picture(exr("b.exr", 1, 1, {{"Y", {1}}}), "").overscan.pixel_count(), 0u);
}

TEST_F(Windows, AreRefusedIfTheyDoNotMeet) {
  EXPECT_THAT(refusal(exr("a.exr", {{"", window(9, 9, 1, 1), window(0, 0, 4, 4), {{"Y", {1}}}}})),
              HasSubstr("lies outside"));
}

TEST_F(Windows, LargerThanIsReadAreRefusedInEitherPlace) {
  EXPECT_THAT(
      refusal(exr("a.exr", {{"", window(0, 0, 1, 1), window(0, 0, 100000, 1), {{"Y", {1}}}}})),
      HasSubstr("its display window has 100000 x 1 pixels; at most 32768 a side"));
  EXPECT_THAT(refusal(exr("b.exr", 100000, 1, {{"Y", std::vector<float>(100000)}})),
              HasSubstr("its data window has 100000 x 1 pixels"));
}

TEST(PixelWindows, FarFromTheOriginDoNotOverflow) {
  constexpr int kFar = std::numeric_limits<int>::max();
  EXPECT_NE(window_problem("w", {kFar, 0, 1, 1}), "");
  EXPECT_NE(window_problem("w", {0, -kFar, 1, 1}), "");
  EXPECT_NE(window_problem("w", {0, 0, 0, 1}), "");
  EXPECT_NE(window_problem("w", {0, 0, 32768, 32768}), "");
  EXPECT_EQ(window_problem("w", {-5, 7, 32768, 4096}), "");
}

TEST_F(Windows, ArePlacesOnAPageInAPng) {
  Png png{.samples = "\xff\xff\xff"};
  png.chunks = png_chunk("oFFs", big_endian(5) + big_endian(7) + '\0');
  EXPECT_THAT(values(read_image(file("a.png", png_file(png)))), ElementsAre(1, 1, 1));
}

/// An EXR in tiles, with smaller levels: `level(i)` gives the values of level i, in rows as long as those of the first.
void write_mip_map(const std::filesystem::path& path, Imf::Header header, unsigned tile,
                   const std::function<std::vector<float>(int)>& level) {
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  header.setTileDescription({tile, tile, Imf::MIPMAP_LEVELS});
  const auto row = 4 * std::size_t(header.dataWindow().max.x + 1);
  Imf::TiledOutputFile tiled(path.c_str(), header);
  for (int i = 0; i < tiled.numLevels(); ++i) {
    std::vector<float> grey = level(i);
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(grey.data()), 4, row));
    tiled.setFrameBuffer(buffer);
    tiled.writeTiles(0, tiled.numXTiles(i) - 1, 0, tiled.numYTiles(i) - 1, i);
  }
}

TEST_F(Windows, AreThoseOfTheFirstLevelOfATiledMipMap) {
  const auto path = directory_.path() / "a.exr";
  write_mip_map(path, Imf::Header(5, 3), 2,
                [](int level) { return std::vector<float>(15, float(level + 1)); });
  EXPECT_THAT(values(read_image(path)),
              ::testing::AllOf(::testing::SizeIs(45), ::testing::Each(1)));
  EXPECT_THAT(layer_names(path), ElementsAre(""));
}

TEST_F(Windows, HoldAllSixFacesOfACubeMap) {
  // Six faces of 4 x 4, one below the other.
  const auto path = directory_.path() / "cube.exr";
  Imf::Header header(4, 24);
  Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
  std::vector<float> faces;
  for (int i = 0; i < 96; ++i) faces.push_back(float(i / 16 + 1));
  write_mip_map(path, header, 4, [&](int) { return faces; });
  const Picture picture = read_picture(path, "");
  EXPECT_EQ(picture.source.display, (PixelWindow{0, 0, 4, 24}));
  for (int y = 0; y < 24; ++y) EXPECT_EQ(picture.image.pixel(3, y)[0], float(y / 4 + 1)) << y;
  EXPECT_EQ(picture.source.mip_levels, 5) << "24, 12, 6, 3, 1 rows";
}

using Curves = PictureFiles;

TEST_F(Curves, AreSrgbForIntegersAndLinearForFloats) {
  const auto red = [&](const std::filesystem::path& path, const char* type, const char* transfer) {
    const Picture picture = read_picture(path, "");
    EXPECT_EQ(picture.source.value_type, type) << path;
    EXPECT_EQ(picture.source.transfer, transfer) << path;
    return picture.image.pixel(0, 0)[0];
  };
  const std::string grey8 = "\x80\x80\x80", grey16 = "\x80\x80\x80\x80\x80\x80";  // both 128 / 255
  EXPECT_NEAR(red(file("a8.png", png_file({.samples = grey8})), "uint8", "sRGB"), kMiddle, 1e-6);
  EXPECT_NEAR(red(file("a16.png", png_file({.bits = 16, .samples = grey16})), "uint16", "sRGB"),
              kMiddle, 1e-6);
  EXPECT_NEAR(red(file("a8.tif", tiff_file({.samples = grey8})), "uint8", "sRGB"), kMiddle, 1e-6);
  EXPECT_NEAR(red(file("a16.tif", tiff_file({.bits = 16, .samples = grey16})), "uint16", "sRGB"),
              kMiddle, 1e-6);
  EXPECT_NEAR(red(file("a.ppm", "P6 1 1 255\n" + grey8), "uint8", "sRGB"), kMiddle, 1e-6);
  EXPECT_NEAR(red(file("a.jpg", grey_jpeg_file(1)), "uint8", "sRGB"), kMiddle, 1e-6);
  EXPECT_NEAR(red(file("a.jpeg", grey_jpeg_file(3)), "uint8", "sRGB"), kMiddle, 1e-6);
  const std::vector<float> floats = {0.5f, 0.5f, 0.5f};
  EXPECT_EQ(red(file("af.tif",
                     tiff_file({.bits = 32, .is_float = true, .samples = little_endian(floats)})),
                "float", "linear"),
            0.5f);
  EXPECT_EQ(red(file("a.pfm", pfm_file(1, 1, floats)), "float", "linear"), 0.5f);
  EXPECT_EQ(red(file("a.hdr", hdr_file(1, 1, "\x80\x80\x80\x80")), "float", "linear"), 0.5f);
  EXPECT_EQ(red(exr("a.exr", 1, 1, {{"Y", {0.5f}, Imf::HALF}}), "half", "linear"), 0.5f);
}

TEST_F(Layers, HaveTheirFirstRowAtTheBottomInAPfm) {
  EXPECT_THAT(values(read_image(file("a.pfm", pfm_file(1, 2, {1, 1, 1, 2, 2, 2})))),
              ElementsAre(2, 2, 2, 1, 1, 1));
}

TEST_F(Curves, AreThoseThatAPngStates) {
  const auto with_gamma = [&](std::uint32_t gamma) {
    Png png{.samples = "\x80\x80\x80"};
    png.chunks = png_chunk("gAMA", big_endian(gamma));
    return read_picture(file("a.png", png_file(png)), "");
  };
  const Picture linear = with_gamma(100000);
  EXPECT_EQ(linear.source.transfer, "linear");
  EXPECT_FLOAT_EQ(linear.image.pixel(0, 0)[0], 128.0f / 255);
  const Picture old_mac = with_gamma(55556);
  EXPECT_EQ(old_mac.source.transfer, "gamma 1.8");
  EXPECT_NEAR(old_mac.image.pixel(0, 0)[0], std::pow(128 / 255.0, 1.8), 1e-6);
  const Picture approximate = with_gamma(45455);
  EXPECT_EQ(approximate.source.transfer, "sRGB (gAMA 1/2.2)");
  EXPECT_NEAR(approximate.image.pixel(0, 0)[0], kMiddle, 1e-6);
  Png absurd{.samples = "\x80\x80\x80", .chunks = png_chunk("gAMA", big_endian(100))};
  EXPECT_THAT(refusal(file("b.png", png_file(absurd))), HasSubstr("colour space"));
}

TEST_F(Curves, ComeFromTheChunksOfAPngAndNoTextOfALibrary) {
  const std::string grey = "\x80\x80\x80";
  const auto png = [&](const std::string& chunks) {
    return read_picture(file("a.png", png_file({.samples = grey, .chunks = chunks})), "");
  };
  const auto text = [](const std::string& key, const std::string& value) {
    return png_chunk("tEXt", key + '\0' + value);
  };
  const std::string srgb = png_chunk("sRGB", std::string(1, '\0'));
  const std::string half = png_chunk("gAMA", big_endian(50000));
  const Picture ppm = read_picture(file("a.ppm", "P6 1 1 255\n" + grey), "");
  // As oiiotool 2.4 writes it from a PPM.
  for (const char* space : {"Rec709", "Linear", "linear", "sRGB", "nonsense", "Gamma2.2", "CMYK"}) {
    const Picture one = png(text("oiio:ColorSpace", space) + text("oiio:Gamma", "3"));
    EXPECT_EQ(one.source.transfer, ppm.source.transfer) << space;
    EXPECT_EQ(values(one.image), values(ppm.image)) << space;
  }
  EXPECT_EQ(png(text("oiio:ColorSpace", "Linear") + half).source.transfer, "gamma 2");
  EXPECT_EQ(png(srgb + half).source.transfer, "sRGB");
  EXPECT_EQ(png(half + half + srgb).source.transfer, "sRGB");
  std::string damaged = png_chunk("gAMA", big_endian(50000));
  damaged.back() ^= 1;
  EXPECT_EQ(png(damaged).source.transfer, "sRGB") << "its checksum is wrong";
  const auto cicp = [](int primaries, int transfer, int matrix, int full) {
    return png_chunk("cICP", {char(primaries), char(transfer), char(matrix), char(full)});
  };
  EXPECT_EQ(png(cicp(1, 8, 0, 1) + srgb).source.transfer, "linear");
  EXPECT_EQ(png(cicp(1, 1, 0, 1)).source.transfer, "Rec709");
  EXPECT_EQ(png(cicp(9, 13, 0, 1)).source.transfer, "sRGB");
  const auto bad = [&](const std::string& chunks) {
    return refusal(file("bad.png", png_file({.samples = grey, .chunks = chunks})));
  };
  EXPECT_THAT(bad(cicp(9, 17, 0, 1)), HasSubstr("transfer characteristics 17"));
  EXPECT_THAT(bad(cicp(77, 13, 0, 1)), HasSubstr("colour primaries 77"));
  EXPECT_THAT(bad(cicp(1, 13, 0, 0)), HasSubstr("full range"));
  EXPECT_THAT(bad(cicp(1, 13, 9, 1)), HasSubstr("no RGB"));
}

TEST_F(Curves, AreLinearInAnExrWhateverALibrarySays) {
  const auto box = window(0, 0, 1, 1);
  const ExrPart plain{"", box, box, {{"R", {0.5f}}, {"G", {0.5f}}, {"B", {0.5f}}, {"A", {0.5f}}}};
  ExrPart said = plain;
  said.texts = {{"oiio:ColorSpace", "sRGB"}, {"oiio:UnassociatedAlpha", "1"}};
  const Picture a = read_picture(exr("a.exr", {plain}), ""),
                b = read_picture(exr("b.exr", {said}), "");
  EXPECT_EQ(values(b.image), values(a.image));
  EXPECT_EQ(b.source.transfer, "linear");
}

using Primaries = PictureFiles;

const Imf::Chromaticities kAcesOfOpenExr({0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f},
                                         {0.32168f, 0.33767f});

TEST_F(Primaries, AreConvertedFromAnExrAndReported) {
  const auto box = window(0, 0, 1, 1);
  ExrPart part{"",
               box,
               box,
               {{"R", {0.5f}},
                {"G", {0.25f}},
                {"B", {0.125f}},
                {"N.X", {1}},
                {"N.Y", {2}},
                {"N.Z", {3}},
                {"g.Y", {0.5f}}}};
  const Picture plain = read_picture(exr("plain.exr", {part}), "");
  EXPECT_THAT(plain.source.chromaticities, ElementsAre());
  EXPECT_THAT(values(plain.image), ElementsAre(0.5f, 0.25f, 0.125f));
  part.chromaticities = Imf::Chromaticities();  // Rec. 709
  EXPECT_THAT(values(read_image(exr("same.exr", {part}))), ElementsAre(0.5f, 0.25f, 0.125f));
  part.chromaticities = kAcesOfOpenExr;
  const auto path = exr("aces.exr", {part});
  const Picture aces = read_picture(path, "");
  EXPECT_EQ(aces.source.chromaticities.size(), 8u);
  EXPECT_FLOAT_EQ(float(aces.source.chromaticities[5]), -0.077f);
  // AP0 to Rec. 709 with Bradford's adaptation from the white of ACES to D65.
  const double matrix[3][3] = {
      {2.52169, -1.13413, -0.38756}, {-0.27648, 1.37272, -0.09624}, {-0.01538, -0.15298, 1.16835}};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(aces.image.pixel(0, 0)[i],
                matrix[i][0] * 0.5 + matrix[i][1] * 0.25 + matrix[i][2] * 0.125, 2e-4);
  EXPECT_THAT(values(read_picture(path, "N").image), ElementsAre(1, 2, 3)) << "no colours";
  EXPECT_THAT(values(read_picture(path, "g").image), ElementsAre(0.5f, 0.5f, 0.5f)) << "grey";
  part.chromaticities = Imf::Chromaticities({0, 0}, {0, 0}, {0, 0}, {0, 0});
  EXPECT_THAT(refusal(exr("zero.exr", {part})), HasSubstr("its chromaticities 0 0 0"));
}

TEST_F(Primaries, ComeFromTheChunksOfAPng) {
  const auto chrm = [](const std::vector<double>& white_first) {
    std::string data;
    for (const double value : white_first) data += big_endian(std::uint32_t(value * 1e5 + 0.5));
    return png_chunk("cHRM", data);
  };
  const std::string p3 = chrm({0.3127, 0.3290, 0.680, 0.320, 0.265, 0.690, 0.150, 0.060});
  const std::string srgb = png_chunk("sRGB", std::string(1, '\0'));
  const auto red = [&](const std::string& chunks) {
    return read_picture(
        file("a.png", png_file({.samples = {'\xff', '\0', '\0'}, .chunks = chunks})), "");
  };
  // Display P3 to sRGB: 1.2249, -0.0420, -0.0197 of its red (CSS Color 4).
  const Picture wide = red(p3);
  EXPECT_NEAR(wide.image.pixel(0, 0)[0], 1.2249, 1e-4);
  EXPECT_NEAR(wide.image.pixel(0, 0)[1], -0.0420, 1e-4);
  EXPECT_NEAR(wide.image.pixel(0, 0)[2], -0.0197, 1e-4);
  EXPECT_THAT(values(red(p3 + srgb).image), ElementsAre(1, 0, 0)) << "sRGB overrides";
  EXPECT_THAT(values(red(chrm({0.3127, 0.3290, 0.64, 0.33, 0.30, 0.60, 0.15, 0.06})).image),
              ElementsAre(1, 0, 0));
  const Picture code = red(png_chunk("cICP", {12, 13, 0, 1}));
  EXPECT_EQ(values(code.image), values(wide.image));
}

TEST_F(Curves, AreNotForAlphaAndColoursAreMultipliedByItAsLight) {
  Png png{.colour_type = 6, .samples = "\x80\x80\x80\x80"};
  const auto path = file("a.png", png_file(png));
  const Picture picture = read_picture(path, "");
  EXPECT_TRUE(picture.source.multiplied_by_alpha);
  EXPECT_NEAR(picture.image.pixel(0, 0)[0], kMiddle * 128 / 255, 1e-6);
  EXPECT_FLOAT_EQ(read_picture(path, "A").image.pixel(0, 0)[0], 128.0f / 255);
  png = {.colour_type = 4, .samples = "\x80\x80"};
  EXPECT_NEAR(read_image(file("ya.png", png_file(png))).pixel(0, 0)[0], kMiddle * 128 / 255, 1e-6);
  EXPECT_FALSE(
      read_picture(file("rgb.png", png_file({.samples = "abc"})), "").source.multiplied_by_alpha);
}

}  // namespace
}  // namespace lobelia
