// SSIM and MS-SSIM against the formulas as double loops over windows.
#include "compare/compare.hpp"
#include "compare/metrics/ssim_windows.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

Image grey_code(int width, int height, int code) {
  const double value = code / 255.0;
  const auto light =
      float(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  return fixtures::flat(width, height, light, light, light);
}

/// {mean of l c s, mean of c s} with 121 weights a window and deviations from the mean, over the windows around a pixel
/// of the region.
std::array<double, 2> plain_ssim(const LumaPlane& a, const LumaPlane& b,
                                 const PixelFlags& region = {}) {
  double weights[11][11], total = 0, lcs = 0, cs = 0;
  for (int j = 0; j < 11; ++j)
    for (int i = 0; i < 11; ++i)
      total += weights[j][i] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / 4.5);
  const auto mean = [&](int x, int y, auto value) {
    double sum = 0;
    for (int j = 0; j < 11; ++j)
      for (int i = 0; i < 11; ++i) sum += weights[j][i] / total * value(x + i, y + j);
    return sum;
  };
  const int across = a.width - 10, down = a.height - 10;
  int windows = 0;
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x) {
      if (!region.empty() && region[std::size_t((y + 5) * a.width + x + 5)] == 0) continue;
      ++windows;
      const auto va = [&](int i, int j) { return double(a.row(j)[i]); };
      const auto vb = [&](int i, int j) { return double(b.row(j)[i]); };
      const double ma = mean(x, y, va), mb = mean(x, y, vb);
      const auto product = [&](auto u, double mu, auto v, double mv) {
        return mean(x, y, [&](int i, int j) { return (u(i, j) - mu) * (v(i, j) - mv); });
      };
      const double contrast = (2 * product(va, ma, vb, mb) + 0.0009) /
                              (product(va, ma, va, ma) + product(vb, mb, vb, mb) + 0.0009);
      cs += contrast;
      lcs += contrast * (2 * ma * mb + 0.0001) / (ma * ma + mb * mb + 0.0001);
    }
  return {lcs / windows, cs / windows};
}

double plain_luma(Rgb light) {
  const auto code = [](double x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  };
  return 0.2126 * code(light.r) + 0.7152 * code(light.g) + 0.0722 * code(light.b);
}

/// Means of 2 x 2 pixels, where an odd border repeats.
LumaPlane half(const LumaPlane& whole) {
  LumaPlane result{(whole.width + 1) / 2, (whole.height + 1) / 2, {}};
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      const auto at = [&](int i, int j) {
        return whole.row(
            std::min(2 * y + j, whole.height - 1))[std::min(2 * x + i, whole.width - 1)];
      };
      result.values.push_back(((at(0, 0) + at(1, 0)) + (at(0, 1) + at(1, 1))) / 4);
    }
  return result;
}

LumaPlane shown_luma(const Image& image) {
  const LumaRows rows = luma(DisplayLight(image, 0));
  LumaPlane plane{rows.width, rows.height, LumaPlane::Values(image.pixel_count())};
  for (int y = 0; y < rows.height; ++y)
    rows.fill(
        y, 0,
        std::span(plane.values).subspan(std::size_t(y * rows.width), std::size_t(rows.width)));
  return plane;
}

TEST(Ssim, IsThePublishedValueForTwoGreys) {
  const Comparison comparison = compare(grey_code(64, 64, 128), grey_code(64, 64, 160), {});
  EXPECT_NEAR(comparison.value("ssim"), 0.975614, 5e-7);
  const double x = 128 / 255.0, y = 160 / 255.0;
  EXPECT_NEAR(comparison.value("ssim"), (2 * x * y + 1e-4) / (x * x + y * y + 1e-4), 1e-7);
}

TEST(Ssim, AgreesWithADoubleLoopOverTheWindowsAlsoAroundThePixelsOfARandomMask) {
  const Image a = fixtures::noise(40, 33, 1, 1.2f), b = fixtures::noise(40, 33, 2, 1);
  for (const std::uint64_t seed : {3, 4}) {
    const Image random = fixtures::noise(40, 33, seed, 1);
    ComparisonOptions options;
    PixelFlags rest;
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
      options.mask.push_back(random.values()[3 * i] < 0.3f);
      rest.push_back(!options.mask.back());
    }
    const Comparison comparison = compare(a, b, options);
    const LumaPlane of_a = shown_luma(a), of_b = shown_luma(b);
    EXPECT_NEAR(comparison.value("ssim"), plain_ssim(of_a, of_b)[0], 1e-12);
    EXPECT_NEAR(comparison.value("ssim.mask"), plain_ssim(of_a, of_b, options.mask)[0], 1e-12);
    EXPECT_NEAR(comparison.value("ssim.outside"), plain_ssim(of_a, of_b, rest)[0], 1e-12);
  }
}

TEST(MsSsim, IsTheProductOfThePowersOfItsScales) {
  // Odd at every scale: 179, 90, 45, 23, 12.
  const Image a = fixtures::highlight(179, 179, 20, 1), b = fixtures::highlight(179, 179, 30, 0.8);
  LumaPlane la = shown_luma(a), lb = shown_luma(b);
  double expected = 1;
  for (const double weight : {0.0448, 0.2856, 0.3001, 0.2363, 0.1333}) {
    const bool last = weight == 0.1333;
    expected *= std::pow(plain_ssim(la, lb)[last ? 0 : 1], weight);
    la = half(la);
    lb = half(lb);
  }
  EXPECT_LT(expected, 0.99);
  EXPECT_NEAR(compare(a, b, {}).value("ms_ssim"), expected, 1e-12);
}

TEST(MsSsim, IsLeftOutBelow176Pixels) {
  const auto value = [](int width) {
    return compare(fixtures::flat(width, 400, 1, 1, 1), fixtures::flat(width, 400, 1, 1, 0.9f), {})
        .value("ms_ssim");
  };
  EXPECT_TRUE(std::isnan(value(175)));
  EXPECT_GT(value(176), 0.9);
}

TEST(Luma, IsTheWeightedSumOfTheCodesOfEveryPixel) {
  Image image = fixtures::noise(37, 301, 4, 1.1f);
  // The dark and the bright end of the curve too.
  for (std::size_t i = 0; i < image.values().size(); i += 2) image.values()[i] *= 0.01f;
  const DisplayLight shown(image, 0);
  const LumaPlane plane = shown_luma(image);
  for (std::size_t i = 0; i < image.pixel_count(); ++i)
    EXPECT_NEAR(plane.values[i], plain_luma(fixtures::shown_at(shown, i)), 3e-7);
}

TEST(SsimScale, HasThePlainMeansOfItsRegions) {
  // One tile, and several with their last ones narrow, low, odd and even.
  for (const auto& [width, height] :
       {std::pair{11, 11}, std::pair{267, 141}, std::pair{530, 139}, std::pair{276, 268}}) {
    const LumaPlane a = shown_luma(fixtures::noise(width, height, 1, 1.2f));
    LumaPlane b = a;
    // The pictures differ in some pixels of each tile, at the border too.
    for (const std::size_t step : {std::size_t{1}, std::size_t{997}, b.values.size() - 1}) {
      for (std::size_t i = 0; i < b.values.size(); i += step) b.values[i] = 1 - b.values[i];
      PixelFlags some(a.values.size());
      for (std::size_t i = 0; i < some.size(); ++i) some[i] = i % 7 != 3;
      const std::span<const std::uint8_t> regions[] = {{}, some};
      const SsimScale scale = ssim_scale(rows_of(a), rows_of(b), regions);
      for (const bool in_some : {false, true}) {
        const auto plain = plain_ssim(a, b, in_some ? some : PixelFlags());
        EXPECT_NEAR(scale.of_region[in_some].similarity, plain[0], 1e-12);
        EXPECT_NEAR(scale.of_region[in_some].contrast_structure, plain[1], 1e-12);
      }
      EXPECT_EQ(scale.half_a.values, half(a).values);
      EXPECT_EQ(scale.half_b.values, half(b).values);
    }
  }
}

}  // namespace
}  // namespace lobelia
