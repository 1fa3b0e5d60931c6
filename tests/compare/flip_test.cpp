// LDR-FLIP and HDR-FLIP against values of NVIDIA's tool.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "compare/compare.hpp"
#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/flip_kernels.hpp"
#include "core/error.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/compare/plain_flip.hpp"

namespace lobelia {
namespace {

/// As the tool decodes an 8-bit sRGB code: in float32, whose last digit its results depend on.
float decoded(int code) {
  const float value = float(code) / 255.0f;
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

Image flat_codes(int r, int g, int b) {
  return fixtures::flat(64, 64, decoded(r), decoded(g), decoded(b));
}

struct Check {
  const char* name;
  Image reference, test;
  double mean, max;
};

// FLIP 1.6, LDR, 67.0206 pixels per degree, 64 x 64; its error map averaged in double.
std::vector<Check> checks() {
  std::vector<Check> list;
  const auto grey = [](int code) { return flat_codes(code, code, code); };
  list.push_back({"black, white", grey(0), grey(255), 0.96738833, 0.96738833});
  list.push_back({"grey 128, 129", grey(128), grey(129), 0.02986309, 0.02986309});
  list.push_back({"grey 128, 160", grey(128), grey(160), 0.33305269, 0.33305269});
  list.push_back(
      {"red, green", flat_codes(255, 0, 0), flat_codes(0, 255, 0), 0.98666495, 0.98666495});
  list.push_back({"blue, black", flat_codes(0, 0, 255), grey(0), 0.95833308, 0.95833308});
  Image dot = grey(128);
  for (float& value : dot.pixel(32, 32)) value = 1;
  list.push_back({"grey 128, a white pixel in it", grey(128), dot, 0.00105004, 0.378678});
  return list;
}

TEST(Flip, AgreesWithTheReferenceTool) {
  for (const Check& check : checks()) {
    const Comparison comparison = compare(check.test, check.reference, {});
    EXPECT_NEAR(comparison.value("flip.ldr.mean"), check.mean, 1e-8) << check.name;
    EXPECT_NEAR(comparison.value("flip.ldr.max"), check.max, 5e-7) << check.name;
  }
}

TEST(Flip, AgreesWithTheReferenceToolOnAPictureOfAllColoursAndEdges) {
  // Computed with the tool's own C++ header at 67.0206 pixels per degree.
  const auto pattern = [](int k) {
    Image image(48, 40);
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 48; ++x)
        for (int c = 0; c < 3; ++c)
          image.pixel(x, y)[std::size_t(c)] = decoded(
              (x * (7 + c * 5) + y * (11 + c * 3) + ((x / 8 + y / 8) % 2) * 60 + (x * y * k) % 37) %
              256);
    return image;
  };
  const Comparison comparison = compare(pattern(3), pattern(2), {});
  EXPECT_NEAR(comparison.value("flip.ldr.mean"), 0.206531537, 1e-8);
  EXPECT_NEAR(comparison.value("flip.ldr.max"), 0.859666228, 1e-8);
}

TEST(Flip, DefaultViewerSees67PixelsPerDegree) {
  EXPECT_NEAR(kDefaultPixelsPerDegree, 67.0206, 5e-5);
}

TEST(Flip, SeesLessOfAFineDifferenceFromFarther) {
  const Image grey = fixtures::flat(64, 64, 0.2f, 0.2f, 0.2f);
  Image checker = grey;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (float& value : checker.pixel(x, y)) value *= (x + y) % 2 ? 1.2f : 0.8f;
  ComparisonOptions near, far;
  near.viewing.pixels_per_degree = 20;
  far.viewing.pixels_per_degree = 120;
  EXPECT_GT(compare(checker, grey, near).value("flip.ldr.mean"),
            3 * compare(checker, grey, far).value("flip.ldr.mean"));
}

TEST(Flip, FiltersKeepAFlatPictureFlatAtEveryDistance) {
  for (const double ppd :
       {kMinPixelsPerDegree, 30.0, kDefaultPixelsPerDegree, kMaxPixelsPerDegree}) {
    const FlipFilters filters{float(ppd)};
    const auto sum = [](const std::vector<float>& taps) {
      double total = 0;
      for (const float tap : taps) total += tap;
      return total;
    };
    // Sums of up to 300 float32 taps.
    EXPECT_NEAR(sum(filters.luminance), 1, 1e-5) << ppd;
    EXPECT_NEAR(sum(filters.red_green), 1, 1e-5) << ppd;
    EXPECT_NEAR(std::pow(sum(filters.blue_yellow_1), 2) + std::pow(sum(filters.blue_yellow_2), 2),
                1, 1e-5)
        << ppd;
    EXPECT_NEAR(sum(filters.gaussian), 1, 1e-5) << ppd;
    EXPECT_NEAR(sum(filters.edge), 0, 1e-5) << ppd;
    EXPECT_NEAR(sum(filters.point), 0, 1e-5) << ppd;
  }
}

/// The error of a tile, without the padding of its rows.
std::vector<float> errors_of(const DisplayLight& a, const DisplayLight& b,
                             const FlipFilters& filters, const FlipTile& tile) {
  const std::size_t padded = flip_padded(std::size_t(tile.width));
  std::vector<float> rows(padded * std::size_t(tile.height)), errors;
  flip_tile_errors(a, b, filters, tile, rows);
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x)
      errors.push_back(rows[padded * std::size_t(y) + std::size_t(x)]);
  return errors;
}

TEST(Flip, ComesOutTheSameWhereverATileEnds) {
  const Image a = fixtures::noise(70, 100, 3, 1.0f), b = fixtures::noise(70, 100, 4, 1.0f);
  const DisplayLight shown_a(a, 0), shown_b(b, 0);
  const FlipFilters filters{float(kDefaultPixelsPerDegree)};
  const std::vector<float> whole = errors_of(shown_a, shown_b, filters, {0, 0, 70, 100});
  for (const FlipTile tile : {FlipTile{0, 37, 70, 4}, FlipTile{11, 0, 33, 100},
                              FlipTile{69, 99, 1, 1}, FlipTile{5, 80, 17, 20}}) {
    const std::vector<float> part = errors_of(shown_a, shown_b, filters, tile);
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x)
        ASSERT_EQ(part[std::size_t(y * tile.width + x)],
                  whole[std::size_t((tile.top + y) * 70 + tile.left + x)])
            << x << ", " << y << " of the tile at " << tile.left << ", " << tile.top;
  }
}

TEST(Flip, AgreesWithADoubleLoopOverEachPixelsWindow) {
  // Widths around the padding, and beyond one tile both ways.
  constexpr std::pair<int, int> kSizes[] = {{1, 1},  {2, 3},   {1, 37},  {15, 4},
                                            {16, 5}, {17, 11}, {33, 29}, {261, 258}};
  const FlipFilters filters{float(kDefaultPixelsPerDegree)};
  for (const auto& [width, height] : kSizes)
    for (const ToneCurve curve : {ToneCurve::kClip, ToneCurve::kAces}) {
      const Image a = fixtures::noise(width, height, 5, 1.3f),
                  b = fixtures::noise(width, height, 6, 1.2f);
      const DisplayLight shown_a(a, -0.5, curve), shown_b(b, -0.5, curve);
      const std::vector<double> plain = fixtures::plain_flip(shown_a, shown_b, filters);
      const std::vector<float> errors = errors_of(shown_a, shown_b, filters, {0, 0, width, height});
      double largest = 0, mean = 0, max = 0;
      for (std::size_t i = 0; i < plain.size(); ++i) {
        largest = std::max(largest, std::abs(plain[i] - double(errors[i])));
        mean += plain[i] / double(plain.size());
        max = std::max(max, plain[i]);
      }
      // float32 against double: some roundings of numbers near 1.
      EXPECT_LT(largest, 4e-6) << width << " x " << height;
      if (curve != ToneCurve::kClip) continue;
      ComparisonOptions options;
      options.viewing.exposure_stops = -0.5;
      const Comparison comparison = compare(a, b, options);
      EXPECT_NEAR(comparison.value("flip.ldr.mean"), mean, 4e-6) << width << " x " << height;
      EXPECT_NEAR(comparison.value("flip.ldr.max"), max, 4e-6) << width << " x " << height;
    }
}

TEST(Flip, HasTheSameErrorsOnEveryInstructionSet) {
  const Image a = fixtures::noise(261, 40, 5, 1.3f), b = fixtures::highlight(261, 40, 20, 1.2);
  const FlipFilters filters{float(kDefaultPixelsPerDegree)};
  const FlipTile whole{0, 0, 261, 40};
  for (const ToneCurve curve : {ToneCurve::kClip, ToneCurve::kAces}) {
    const DisplayLight shown_a(a, 0.3, curve), shown_b(b, 0.3, curve);
    const std::vector<float> widest = errors_of(shown_a, shown_b, filters, whole);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      const std::vector<float> errors = errors_of(shown_a, shown_b, filters, whole);
      hwy::SetSupportedTargetsForTest(0);
      // A power, rounded from double, may come out as the float beside it.
      for (std::size_t i = 0; i < errors.size(); ++i)
        ASSERT_NEAR(errors[i], widest[i], 1.2e-7) << hwy::TargetName(target) << ", pixel " << i;
    }
  }
}

TEST(HdrFlip, AgreesWithTheReferenceToolOnConstants) {
  const Image reference = fixtures::flat(64, 64, 0.25f, 0.25f, 0.25f);
  const Image picture = fixtures::flat(64, 64, 0.5f, 0.5f, 0.5f);
  ComparisonOptions options;
  const HdrExposures automatic = automatic_exposures(reference);
  EXPECT_NEAR(automatic.start_stops, 3.083297, 5e-7);
  EXPECT_EQ(automatic.start_stops, automatic.stop_stops);
  EXPECT_EQ(automatic.count, 2);
  options.viewing.hdr_exposures = automatic;
  const Comparison comparison = compare(picture, reference, options);
  EXPECT_NEAR(comparison.value("flip.hdr.mean"), 0.14483313, 1e-8);
  EXPECT_NEAR(comparison.value("flip.hdr.max"), 0.14483313, 1e-8);
  // The same range in the seven digits that are printed: off by 3.1e-7, as a root is taken of noise.
  options.viewing.hdr_exposures = HdrExposures{3.083297, 3.083297, 2};
  EXPECT_NEAR(compare(picture, reference, options).value("flip.hdr.mean"), 0.14483313, 1e-6);
}

TEST(HdrFlip, AgreesWithTheReferenceToolOnARamp) {
  const auto ramp = [](float factor) {
    Image image(64, 64);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x)
        for (float& value : image.pixel(x, y)) value = factor * std::exp2(float(x / 4 - 8));
    return image;
  };
  const Image reference = ramp(1), picture = ramp(1.25f);
  ComparisonOptions options;
  options.viewing.hdr_exposures = automatic_exposures(reference);
  EXPECT_NEAR(options.viewing.hdr_exposures->start_stops, -5.916703, 5e-7);
  EXPECT_NEAR(options.viewing.hdr_exposures->stop_stops, 1.083297, 5e-7);
  EXPECT_EQ(options.viewing.hdr_exposures->count, 7);
  EXPECT_NEAR(compare(picture, reference, options).value("flip.hdr.mean"), 0.21011607, 1e-8);
}

TEST(HdrFlip, IsLeftOutWithoutARangeOfExposures) {
  const Image image = fixtures::flat(8, 8, 1, 1, 1);
  EXPECT_TRUE(std::isnan(compare(image, image, {}).value("flip.hdr.mean")));
}

TEST(HdrFlip, SeesWhatIsTooBrightForOneExposure) {
  const Image a = fixtures::flat(32, 32, 50, 50, 50), b = fixtures::flat(32, 32, 100, 100, 100);
  ComparisonOptions options;
  options.viewing.hdr_exposures = HdrExposures{-8, 0, 9};
  const Comparison comparison = compare(a, b, options);
  EXPECT_EQ(comparison.value("flip.ldr.mean"), 0);
  EXPECT_GT(comparison.value("flip.hdr.mean"), 0.1);
}

TEST(HdrFlip, IsTheSameForHugeAndNegativeValuesAsForWhiteAndBlack) {
  const Image black = fixtures::flat(16, 16, 0, 0, 0),
              white = fixtures::flat(16, 16, 1e9f, 1e9f, 1e9f);
  const Image huge = fixtures::flat(16, 16, 3e38f, 3e38f, 3e38f);
  const Image negative = fixtures::flat(16, 16, -1, -1, -1);
  ComparisonOptions options;
  options.viewing.hdr_exposures = HdrExposures{0, 4, 2};
  const double expected = compare(black, white, options).value("flip.hdr.mean");
  EXPECT_EQ(compare(negative, huge, options).value("flip.hdr.mean"), expected);
}

TEST(HdrFlip, HasAnAutomaticRangeForASmallHighlightOnBlackFromTheMedianOfTheLitPixels) {
  Image small = fixtures::flat(16, 16, 0, 0, 0);
  for (int x = 0; x < 9; ++x) small.pixel(x, 0)[1] = float(1 << x);
  Image lit = fixtures::flat(9, 1, 0, 0, 0);
  for (int x = 0; x < 9; ++x) lit.pixel(x, 0)[1] = float(1 << x);
  const HdrExposures of_small = automatic_exposures(small), of_lit = automatic_exposures(lit);
  EXPECT_EQ(of_small.start_stops, of_lit.start_stops);
  EXPECT_EQ(of_small.stop_stops, of_lit.stop_stops);
  EXPECT_EQ(of_small.count, 4) << "256 is four stops above 16";
}

TEST(HdrFlip, RefusesAnAutomaticRangeOfBlackInWords) {
  try {
    automatic_exposures(fixtures::flat(8, 8, 0, 0, 0));
    FAIL() << "it was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    EXPECT_STREQ(error.what(),
                 "the automatic range of exposures needs a reference with a pixel above 0");
  }
}

}  // namespace
}  // namespace lobelia
