// LDR-FLIP and HDR-FLIP against values of NVIDIA's tool.
#include "base/system/error.hpp"
#include "compare/compare.hpp"
#include "compare/maps/difference_map.hpp"
#include "compare/metrics/flip_error.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/test.hpp"

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
    // Flat pictures have no features. In the tool they have, from roots of float32's rounding: measured 3.1e-5.
    EXPECT_NEAR(comparison.value("flip.ldr.mean"), check.mean, 5e-5) << check.name;
    EXPECT_NEAR(comparison.value("flip.ldr.max"), check.max, 5e-5) << check.name;
  }
}

TEST(Flip, AgreesWithTheReferenceToolInAllColours) {
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
  // Measured 6e-8.
  EXPECT_NEAR(comparison.value("flip.ldr.max"), 0.859666228, 2e-7);
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
  // Measured 2.4e-7.
  EXPECT_NEAR(compare(picture, reference, options).value("flip.hdr.mean"), 0.21011607, 5e-7);
  // The other curves, in the digits that the tool prints; its sum is in float32.
  for (const auto& [curve, start, mean] : {std::tuple(ToneCurve::kReinhard, -4.4975, 0.167316),
                                           {ToneCurve::kHable, -5.3549, 0.181528}}) {
    HdrExposures asked;
    asked.curve = curve;
    options.viewing.hdr_exposures = automatic_exposures(reference, asked);
    EXPECT_NEAR(options.viewing.hdr_exposures->start_stops, start, 5e-5);
    EXPECT_EQ(options.viewing.hdr_exposures->count, 7);
    EXPECT_NEAR(compare(picture, reference, options).value("flip.hdr.mean"), mean, 2e-6);
  }
}

/// A tone curve as its formula stands, in double. Negative light counts as none.
std::array<double, 3> plainly_toned(std::array<double, 3> light, ToneCurve curve) {
  for (double& x : light) x = std::max(x, 0.0);
  const double luminance = 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2];
  for (double& x : light) {
    if (curve == ToneCurve::kReinhard) x /= 1 + luminance;
    if (curve == ToneCurve::kAces) {
      const double y = 0.6 * x;
      x = y * (2.51 * y + 0.03) / (y * (2.43 * y + 0.59) + 0.14);
    }
    // Hable's curve with the tool's numbers.
    if (curve == ToneCurve::kHable)
      x = x * (0.231683 * x + 0.013791) / (x * (0.18 * x + 0.3) + 0.018);
    x = std::min(x, 1.0);
  }
  return light;
}

TEST(ToneCurve, IsItsFormulaInDoubleToSixDigits) {
  Image image = fixtures::noise(37, 5, 2, 9.0f);
  image.pixel(3, 0)[1] = -2;
  image.pixel(4, 0)[0] = 3e38f;
  for (const ToneCurve curve : {ToneCurve::kAces, ToneCurve::kReinhard, ToneCurve::kHable})
    for (const double stops : {-3.0, 0.0, 2.5}) {
      const DisplayLight shown(image, stops, curve);
      for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        const float* v = image.values().data() + 3 * i;
        const double gain = std::exp2(stops);
        const auto expected = plainly_toned({gain * v[0], gain * v[1], gain * v[2]}, curve);
        const Rgb is = fixtures::shown_at(shown, i);
        // An infinite value loses the formula's other channels.
        if (v[0] > 1e30f) {
          EXPECT_EQ(is.r, 1);
          continue;
        }
        EXPECT_NEAR(is.r, expected[0], 1e-6);
        EXPECT_NEAR(is.g, expected[1], 1e-6);
        EXPECT_NEAR(is.b, expected[2], 1e-6);
      }
    }
}

TEST(HdrExposures, ShowExtremesAt85PerCentOfEachCurve) {
  const Image reference = fixtures::noise(31, 31, 3, 5.0f);
  std::vector<double> luminances;
  for (std::size_t i = 0; i < reference.values().size(); i += 3) {
    const float* v = reference.values().data() + i;
    luminances.push_back(0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]);
  }
  std::ranges::sort(luminances);
  for (const ToneCurve curve : {ToneCurve::kAces, ToneCurve::kReinhard, ToneCurve::kHable}) {
    HdrExposures asked;
    asked.curve = curve;
    const HdrExposures range = automatic_exposures(reference, asked);
    EXPECT_EQ(range.curve, curve);
    for (const auto& [stops, luminance] :
         {std::pair(range.start_stops, luminances.back()),
          std::pair(range.stop_stops, luminances[luminances.size() / 2])}) {
      const double light = std::exp2(stops) * luminance;
      EXPECT_NEAR(plainly_toned({light, light, light}, curve)[0], 0.85, 1e-5);
    }
    EXPECT_EQ(range.count, std::max(2, int(std::ceil(range.stop_stops - range.start_stops))));
  }
}

TEST(HdrExposures, KeepGivenExposures) {
  const Image reference = fixtures::noise(31, 31, 3, 5.0f);
  const HdrExposures all = automatic_exposures(reference);
  HdrExposures asked{0, 4, 2, true};
  asked.given_stop = true;
  HdrExposures range = automatic_exposures(reference, asked);
  EXPECT_EQ(range.start_stops, all.start_stops);
  EXPECT_EQ(range.stop_stops, 4);
  EXPECT_EQ(range.count, count_of_exposures(all.start_stops, 4));
  asked.given_count = true;
  EXPECT_EQ(automatic_exposures(reference, asked).count, 2);
  asked.stop_stops = -50;
  EXPECT_THROW(automatic_exposures(reference, asked), Error);
}

TEST(FlipMaps, HaveTheLargestErrorOverAllExposures) {
  const Image a = fixtures::noise(70, 40, 1, 3.0f);
  Image b = fixtures::noise(70, 40, 2, 3.0f);
  for (int x = 0; x < 70; ++x) std::ranges::copy(a.pixel(x, 39), b.pixel(x, 39).begin());
  Viewing viewing;
  viewing.hdr_exposures = HdrExposures{-4, 2, 4};
  viewing.hdr_exposures->curve = ToneCurve::kReinhard;
  viewing.pixels_per_degree = 40;
  viewing.exposure_stops = -0.5;
  const auto map = [&](const char* id) {
    return measure_difference_map(*find_difference_map(id), a, b, viewing);
  };
  const PixelValues errors = map("flip.hdr"), stops = map("flip.hdr.exposure");
  const FlipFilters filters(40);
  EXPECT_EQ(map("flip.ldr"), flip_error_map(DisplayLight(a, -0.5), DisplayLight(b, -0.5), filters));
  PixelValues largest(a.pixel_count(), 0.0f), where(a.pixel_count(), -4.0f);
  for (const float stop : {-4.0f, -2.0f, 0.0f, 2.0f}) {
    const PixelValues one =
        flip_error_map(DisplayLight(a, double(stop), ToneCurve::kReinhard),
                       DisplayLight(b, double(stop), ToneCurve::kReinhard), filters);
    for (std::size_t i = 0; i < one.size(); ++i)
      if (one[i] > largest[i]) largest[i] = one[i], where[i] = stop;
  }
  EXPECT_EQ(errors, largest);
  EXPECT_EQ(stops, where);
  ComparisonOptions options;
  options.viewing = viewing;
  double sum = 0;
  for (const float error : errors) sum += double(error);
  EXPECT_NEAR(compare(a, b, options).value("flip.hdr.mean"), sum / double(errors.size()), 1e-9);
}

TEST(HdrFlip, TakesItsRangeFromTheMedianOfLitPixels) {
  Image small = fixtures::flat(16, 16, 0, 0, 0);
  for (int x = 0; x < 9; ++x) small.pixel(x, 0)[1] = float(1 << x);
  Image lit = fixtures::flat(9, 1, 0, 0, 0);
  for (int x = 0; x < 9; ++x) lit.pixel(x, 0)[1] = float(1 << x);
  const HdrExposures of_small = automatic_exposures(small), of_lit = automatic_exposures(lit);
  EXPECT_EQ(of_small.start_stops, of_lit.start_stops);
  EXPECT_EQ(of_small.stop_stops, of_lit.stop_stops);
  EXPECT_EQ(of_small.count, 4) << "256 is four stops above 16";
}

}  // namespace
}  // namespace lobelia
