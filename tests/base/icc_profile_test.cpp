// Profiles made byte by byte (ICC.1:2022) or by LittleCMS, against the matrices of published primaries.
#include <lcms2.h>
#include <zlib.h>

#include "base/pictures/colour.hpp"
#include "base/pictures/picture_colour.hpp"
#include "tests/base/picture_fixture.hpp"
#include "tests/test.hpp"

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

/// Red, green and blue at the white D50, as profiles have them.
struct Colours {
  std::string red, green, blue;
};
const Colours kSrgbColours{xyz(0.43607, 0.22249, 0.01392), xyz(0.38515, 0.71687, 0.09708),
                           xyz(0.14307, 0.06061, 0.71410)};
// As in Apple's, Adobe's and Kodak's profiles.
const Colours kDisplayP3{xyz(0.51512, 0.24120, -0.00105), xyz(0.29198, 0.69225, 0.04189),
                         xyz(0.15710, 0.06657, 0.78407)};
const Colours kAdobeRgb{xyz(0.60974, 0.31111, 0.01947), xyz(0.20528, 0.62567, 0.06087),
                        xyz(0.14919, 0.06322, 0.74457)};
const Colours kProPhoto{xyz(0.79767, 0.28804, 0), xyz(0.13519, 0.71188, 0),
                        xyz(0.03134, 0.00009, 0.82491)};

std::string profile_of(const std::vector<std::pair<std::string, std::string>>& tags,
                       const std::string& kind) {
  std::string index = big_endian(std::uint32_t(tags.size())), data;
  const std::size_t start = 128 + 4 + 12 * tags.size();
  for (const auto& [name, bytes] : tags) {
    index += name + big_endian(std::uint32_t(start + data.size())) +
             big_endian(std::uint32_t(bytes.size()));
    data += bytes + std::string((4 - bytes.size() % 4) % 4, '\0');
  }
  std::string header(128, '\0');
  header.replace(0, 4, big_endian(std::uint32_t(start + data.size())));
  header.replace(8, 4, std::string("\4\x30\0\0", 4));
  header.replace(12, 12, kind);
  header.replace(36, 4, "acsp");
  header.replace(68, 12, xyz(0.9642, 1, 0.82491).substr(8));
  return header + index + data;
}

std::string profile(const std::string& curve, const Colours& colours = kSrgbColours) {
  return profile_of({{"rXYZ", colours.red},
                     {"gXYZ", colours.green},
                     {"bXYZ", colours.blue},
                     {"rTRC", curve},
                     {"gTRC", curve},
                     {"bTRC", curve}},
                    "mntrRGB XYZ ");
}

std::string grey_profile(const std::string& curve) {
  return profile_of({{"kTRC", curve}, {"wtpt", xyz(0.9642, 1, 0.82491)}}, "mntrGRAYXYZ ");
}

std::string iccp(const std::string& profile) {
  uLongf size = compressBound(profile.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(profile.data()), profile.size());
  return png_chunk("iCCP", "test" + std::string(2, '\0') + packed.substr(0, size));
}

/// RGB of 16 bits: grey steps, pure colours and random ones.
std::string samples(std::size_t pixels) {
  std::mt19937 random(7);
  std::string text;
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t grey = std::uint32_t(i * 65535 / 8);
      text += big_endian(i <= 8 ? grey : i <= 11 ? (c == i - 9) * 65535u : random() % 65536, 2);
    }
  return text;
}

class IccProfiles : public PictureFiles {
 protected:
  static constexpr std::uint32_t kPixels = 64;
  Picture read(const std::string& profile, const std::string& more = "") {
    return read_picture(file("a.png", png_file({.width = kPixels,
                                                .bits = 16,
                                                .samples = samples(kPixels),
                                                .chunks = more + iccp(profile)})),
                        "");
  }
  /// By the published primaries and the curve itself.
  static Image expected(const Chromaticities& from, const std::function<double(double)>& curve) {
    const std::string text = samples(kPixels);
    Image image(int(kPixels), 1);
    for (std::size_t i = 0; i < image.values().size(); ++i)
      image.values()[i] = float(curve(double(number_at(text, 2 * i, false, 2)) / 65535));
    lobelia::apply(*to_rec709(from), image);
    return image;
  }
  static void expect_near(const Image& a, const Image& b, double by) {
    ASSERT_EQ(a.pixel_count(), b.pixel_count());
    for (std::size_t i = 0; i < a.values().size(); ++i)
      ASSERT_NEAR(a.values()[i], b.values()[i], by) << "value " << i;
  }
};

double srgb_light(double value) { return double(srgb_decoded(float(value))); }
double adobe(double value) { return std::pow(value, 563.0 / 256); }
double prophoto(double value) { return std::pow(value, 461.0 / 256); }

constexpr Chromaticities kP3{0.680, 0.320, 0.265, 0.690, 0.150, 0.060, 0.3127, 0.3290},
    kAdobe{0.64, 0.33, 0.21, 0.71, 0.15, 0.06, 0.3127, 0.3290},
    kRomm{0.7347, 0.2653, 0.1596, 0.8404, 0.0366, 0.0001, 0.3457, 0.3585};

TEST_F(IccProfiles, ApplyPrimariesAndCurvesWithoutClipping) {
  const Picture p3 = read(profile(parametric(2.4), kDisplayP3));
  EXPECT_EQ(p3.source.transfer, kByProfile);
  EXPECT_FALSE(p3.source.icc_is_srgb);
  // Profiles and chromaticities are rounded to four and five digits.
  expect_near(p3.image, expected(kP3, srgb_light), 6e-4);
  EXPECT_LT(p3.image.pixel(9, 0)[1], -0.04f) << "red outside of Rec. 709";
  expect_near(read(profile(power(563.0 / 256), kAdobeRgb)).image, expected(kAdobe, adobe), 6e-4);
  expect_near(read(profile(power(461.0 / 256), kProPhoto)).image, expected(kRomm, prophoto), 2e-3);
  expect_near(read(profile(table(4096, 0), kDisplayP3)).image, expected(kP3, srgb_light), 6e-4);
}

/// PCS Lab of an RGB of Display P3, for a table.
int lab_of_p3(const cmsUInt16Number in[], cmsUInt16Number out[], void*) {
  const double columns[3][3] = {
      {0.51512, 0.24120, -0.00105}, {0.29198, 0.69225, 0.04189}, {0.15710, 0.06657, 0.78407}};
  double sum[3] = {};
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 3; ++k) sum[k] += srgb_light(in[c] / 65535.0) * columns[c][k];
  const cmsCIEXYZ xyz{sum[0], sum[1], sum[2]};
  cmsCIELab lab;
  cmsXYZ2Lab(cmsD50_XYZ(), &lab, &xyz);
  cmsFloat2LabEncoded(out, &lab);
  return 1;
}

TEST_F(IccProfiles, ApplyTables) {
  void* const made = cmsCreateProfilePlaceholder(nullptr);
  cmsSetProfileVersion(made, 4.3);
  cmsSetDeviceClass(made, cmsSigDisplayClass);
  cmsSetColorSpace(made, cmsSigRgbData);
  cmsSetPCS(made, cmsSigLabData);
  cmsPipeline* const pipeline = cmsPipelineAlloc(nullptr, 3, 3);
  cmsStage* const grid = cmsStageAllocCLut16bit(nullptr, 33, 3, 3, nullptr);
  cmsStageSampleCLut16bit(grid, lab_of_p3, nullptr, 0);
  cmsPipelineInsertStage(pipeline, cmsAT_BEGIN, cmsStageAllocToneCurves(nullptr, 3, nullptr));
  cmsPipelineInsertStage(pipeline, cmsAT_END, grid);
  cmsPipelineInsertStage(pipeline, cmsAT_END, cmsStageAllocToneCurves(nullptr, 3, nullptr));
  ASSERT_TRUE(cmsWriteTag(made, cmsSigAToB0Tag, pipeline));
  std::uint32_t size = 0;
  ASSERT_TRUE(cmsSaveProfileToMem(made, nullptr, &size));
  std::string bytes(size, '\0');
  cmsSaveProfileToMem(made, bytes.data(), &size);
  cmsPipelineFree(pipeline);
  cmsCloseProfile(made);
  const Picture picture = read(bytes);
  EXPECT_EQ(picture.source.transfer, kByProfile);
  // Between the table's 33 steps values are interpolated.
  expect_near(picture.image, expected(kP3, srgb_light), 0.02);
}

TEST_F(IccProfiles, ChangeNothingIfTheyAreSrgb) {
  const auto plain = read_picture(
      file("b.png", png_file({.width = kPixels, .bits = 16, .samples = samples(kPixels)})), "");
  for (const std::string& bytes : {profile(parametric(2.4)), profile(table(1024, 0))}) {
    const Picture picture = read(bytes);
    EXPECT_TRUE(picture.source.icc_is_srgb);
    EXPECT_EQ(picture.source.transfer, "sRGB");
    EXPECT_EQ(values(picture.image), values(plain.image));
  }
  for (const std::string& bytes :
       {profile(power(2.2)), profile(table(1024, 1.8)),
        profile(std::string("curv\0\0\0\0\0\0\0\0", 12)), profile(parametric(2.4), kDisplayP3)})
    EXPECT_FALSE(read(bytes).source.icc_is_srgb);
}

TEST_F(IccProfiles, ServeGreyPicturesIfTheyAreGrey) {
  const std::string row = big_endian(0, 2) + big_endian(0x8000, 2) + big_endian(0xffff, 2);
  const auto grey = [&](const std::string& bytes) {
    return read_picture(
        file(
            "g.png",
            png_file(
                {.width = 3, .bits = 16, .colour_type = 0, .samples = row, .chunks = iccp(bytes)})),
        "");
  };
  const Picture picture = grey(grey_profile(power(1.8)));
  EXPECT_EQ(picture.source.transfer, kByProfile);
  const double middle = std::pow(32768.0 / 65535, std::lround(1.8 * 256) / 256.0);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(picture.image.pixel(0, 0)[c], 0, 1e-5);
    EXPECT_NEAR(picture.image.pixel(1, 0)[c], middle, 1e-4);
    EXPECT_NEAR(picture.image.pixel(2, 0)[c], 1, 1e-4);
  }
  // Programs that drop colours leave a profile of RGB, which is for three equal values. libpng refuses it.
  const Picture tiff =
      read_picture(file("g.tif", tiff_file({.samples_per_pixel = 1,
                                            .bits = 16,
                                            .photometric = 1,
                                            .samples = std::string("\0\x80", 2),
                                            .profile = profile(power(1.8), kAdobeRgb)})),
                   "");
  EXPECT_NEAR(tiff.image.pixel(0, 0)[2], middle, 2e-4);
  EXPECT_THAT(refusal(file("h.png", png_file({.colour_type = 0,
                                              .samples = "x",
                                              .chunks = iccp(profile(power(1.8), kAdobeRgb))}))),
              HasSubstr("libpng refuses its ICC profile"));
}

TEST_F(IccProfiles, CountForFloatsIfTheyAreLinear) {
  const std::vector<float> floats = {0.5f, 0.25f, 2};
  const auto read_tiff = [&](const std::string& bytes) {
    return read_picture(file("a.tif", tiff_file({.bits = 32,
                                                 .is_float = true,
                                                 .samples = little_endian(floats),
                                                 .profile = bytes})),
                        "");
  };
  const Picture linear = read_tiff(profile(power(1), kDisplayP3));
  EXPECT_EQ(linear.source.transfer, kByProfile);
  Image one(1, 1);
  std::copy(floats.begin(), floats.end(), one.values().begin());
  lobelia::apply(*to_rec709(kP3), one);
  expect_near(linear.image, one, 1e-3);
  const Picture curved = read_tiff(profile(parametric(2.4), kDisplayP3));
  EXPECT_EQ(curved.source.transfer, "linear");
  EXPECT_EQ(values(curved.image), floats);
}

TEST_F(IccProfiles, ComeAfterTheChunkCicpAndBeforeAllOthers) {
  const std::string wide = profile(parametric(2.4), kDisplayP3);
  EXPECT_EQ(read(wide, png_chunk("cICP", {1, 8, 0, 1})).source.transfer, "linear");
  EXPECT_EQ(read(wide, png_chunk("gAMA", big_endian(50000))).source.transfer, kByProfile);
}

TEST_F(IccProfiles, AreAnErrorOfThePictureIfDamaged) {
  const auto jpeg_with = [&](const std::string& bytes) {
    const std::string jpeg = grey_jpeg_file(3);
    const std::string data = std::string("ICC_PROFILE\0\1\1", 14) + bytes;
    return file("a.jpg", jpeg.substr(0, 2) + "\xff\xe2" +
                             big_endian(std::uint32_t(data.size() + 2), 2) + data + jpeg.substr(2));
  };
  const std::string good = profile(parametric(2.4), kDisplayP3);
  EXPECT_EQ(read_picture(jpeg_with(good), "").source.transfer, kByProfile);
  for (const std::size_t length :
       {std::size_t{1}, std::size_t{100}, std::size_t{140}, good.size() / 2})
    EXPECT_THAT(refusal(jpeg_with(good.substr(0, length))), HasSubstr("its ICC profile"));
  EXPECT_THAT(refusal(jpeg_with(grey_profile(power(2)))),
              HasSubstr("is of grey, but it has colours"));
  std::string cmyk = good;
  cmyk.replace(16, 4, "CMYK");
  EXPECT_THAT(refusal(jpeg_with(cmyk)), HasSubstr("not of RGB or grey"));
  const Colours none{xyz(0, 0, 0), xyz(0, 0, 0), xyz(0, 0, 0)},
      equal{kSrgbColours.red, kSrgbColours.red, kSrgbColours.red};
  for (const std::string& bytes : {profile(parametric(2.4), none), profile(parametric(2.4), equal),
                                   profile(power(0)), profile(power(100))})
    EXPECT_THAT(refusal(jpeg_with(bytes)), HasSubstr("shows different colours as one"));
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    std::string bad = good;
    for (int k = 0; k < 4; ++k) bad[random() % bad.size()] = char(random());
    try {
      const Image picture = read_image(jpeg_with(bad));
      for (const float value : picture.values()) EXPECT_TRUE(std::isfinite(value)) << i;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kInput);
      EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("crashed")));
    }
  }
}

}  // namespace
}  // namespace lobelia
