// LDR-FLIP and HDR-FLIP against values of NVIDIA's tool.
#include <hwy/targets.h>

#include "base/system/error.hpp"
#include "compare/compare.hpp"
#include "compare/display_light.hpp"
#include "compare/maps/difference_map.hpp"
#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/flip_kernels.hpp"
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

// FLIP's errors in float64, on pictures where float32 or a careless order of operations shows: powers of almost nothing and
// roots of differences that cancel. The figures are those of the paper's formulas in double, each pixel's windows one after
// the other, by a program that shares no code with ours.

template <class Value>
Image picture(int width, int height, Value value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[std::size_t(c)] = float(value(x, y, c));
  return image;
}

/// The picture with every value changed by a function of it.
template <class Change>
Image changed(Image image, Change change) {
  for (float& value : image.values()) value = float(change(value));
  return image;
}

struct Accurate {
  const char* name;
  Image a, b;
  double mean, largest;
  double pixels_per_degree = kDefaultPixelsPerDegree, stops = 0;
};

/// On every instruction set, in both orders. Measured for every pixel: at most 2.6e-7.
void expect_accurate(const std::vector<Accurate>& cases) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    for (const Accurate& one : cases)
      for (const bool exchanged : {false, true}) {
        const DisplayLight a(one.a, one.stops), b(one.b, one.stops);
        const PixelValues errors = flip_error_map(exchanged ? b : a, exchanged ? a : b,
                                                  FlipFilters(one.pixels_per_degree));
        double sum = 0;
        for (const float error : errors) sum += double(error);
        EXPECT_NEAR(sum / double(errors.size()), one.mean, 3e-7) << one.name << ' ' << exchanged;
        EXPECT_NEAR(*std::ranges::max_element(errors), one.largest, 1e-6)
            << one.name << ' ' << exchanged;
      }
    hwy::SetSupportedTargetsForTest(0);
  }
}

TEST(FlipAccuracy, IsAMillionthOnRandomPicturesAtAnyDistance) {
  const Image a = fixtures::noise(47, 38, 1, 1.2f), other = fixtures::noise(47, 38, 2, 1.2f);
  // From nothing in common to almost equal.
  const auto near = [&](double share) {
    Image b = a;
    for (std::size_t i = 0; i < b.values().size(); ++i)
      b.values()[i] =
          float((1 - share) * double(a.values()[i]) + share * double(other.values()[i]));
    return b;
  };
  const auto tiny = [](std::uint64_t seed) { return fixtures::noise(3, 2, seed, 1); };
  expect_accurate({{"all other", a, other, 0.4125908621, 0.9656521625},
                   {"near by", a, other, 0.9069904134, 0.9968688967, 8},
                   {"far off", a, other, 0.2662395224, 0.7477751451, 130},
                   {"a hundredth, near by", a, near(1e-2), 0.03786278561, 0.1173998671, 20},
                   {"a hundred thousandth", a, near(1e-5), 0.0001137475932, 0.0003514529916},
                   {"a rounding", a, near(1e-8), 7.139224156e-07, 2.396772673e-06},
                   {"a few pixels, far off", tiny(1), tiny(2), 0.813869167, 0.8731886569, 90}});
}

TEST(FlipAccuracy, IsAMillionthOnFlatPictures) {
  const auto flat = [](float r, float g, float b) { return fixtures::flat(23, 9, r, g, b); };
  const auto grey = [&](float v) { return flat(v, v, v); };
  const Image black = grey(0), white = grey(1);
  const float step = 1.0f / (1 << 24), knee = 216.0f / 24389;
  expect_accurate(
      {{"black, white", black, white, 0.9673797617, 0.9673797617},
       {"grey, lighter", grey(0.2f), grey(0.21f), 0.06198911494, 0.06198911494},
       {"grey, a rounding lighter", grey(0.2f), flat(0.2f + 2 * step, 0.2f, 0.2f + 2 * step),
        2.570923826e-05, 2.570923826e-05},
       {"white, almost white", white, grey(1 - step), 6.513235717e-06, 6.513235717e-06},
       {"red, almost red", flat(1, 0, 0), flat(1 - step, 0, 0), 9.445844773e-06, 9.445844773e-06},
       {"red, red with almost no green", flat(1, 0, 0), flat(1, 1e-12f, 0), 8.1859839e-09,
        8.1859839e-09},
       {"green, blue", flat(0, 1, 0), flat(0, 0, 1), 1, 1},
       {"blue, cyan", flat(0, 0, 1), flat(0, 1, 1), 0.9781266179, 0.9781266179},
       {"black, the smallest number", black, grey(1e-45f), 0, 0},
       {"black, denormal", black, flat(1e-39f, 0, 3e-40f), 0, 0},
       {"black, 1e-20", black, flat(1e-20f, 1e-20f, 5e-21f), 0, 0},
       {"black, 1e-8", black, flat(1e-8f, 1e-8f, 5e-9f), 1.651473765e-05, 1.651473765e-05},
       {"black, 1e-4", black, flat(1e-4f, 1e-4f, 5e-5f), 0.01042493836, 0.01042493836},
       // About the end of the straight part of Lab's curve.
       {"at the knee", grey(knee), grey(knee + 2e-9f), 5.225612511e-06, 5.225612511e-06},
       {"over the knee", grey(knee - 1e-7f), grey(knee + 1e-7f), 0.0001376275281, 0.0001376275281},
       {"far over the knee", grey(knee - 1e-4f), grey(knee + 1e-3f), 0.05598414649,
        0.05598414649}});
}

// FLIP skips what is far from every difference. These pictures are several tiles, bands and blocks large.
TEST(FlipAccuracy, IsAMillionthOnPicturesThatDifferInAFewPlaces) {
  const auto with = [](Image image, std::initializer_list<std::array<int, 4>> places) {
    for (const auto& [left, top, width, height] : places)
      for (int y = top; y < top + height; ++y)
        for (int x = left; x < left + width; ++x) image.pixel(x, y)[std::size_t(x + y) % 3] += 0.1f;
    return image;
  };
  const Image wide = fixtures::noise(299, 57, 3, 1.1f), high = fixtures::noise(97, 131, 4, 1.1f);
  expect_accurate({{"a pixel", wide, with(wide, {{150, 20, 1, 1}}), 6.55152244e-05, 0.029926256},
                   {"two places", wide, with(wide, {{3, 50, 20, 7}, {290, 0, 9, 12}}),
                    0.002170835608, 0.2556462068, 110},
                   {"beside a tile's edge", wide, with(wide, {{127, 31, 2, 2}, {255, 5, 1, 12}}),
                    0.0002675823984, 0.4400062292, 12},
                   {"corners", high, with(high, {{0, 0, 1, 1}, {96, 130, 1, 1}, {0, 130, 3, 1}}),
                    0.0002735656374, 0.2768229631},
                   {"bands", high, with(high, {{40, 63, 5, 1}, {40, 64, 5, 1}, {11, 100, 6, 9}}),
                    0.0009970949561, 0.2129026099, 40}});
}

TEST(FlipAccuracy, IsAMillionthOnEdges) {
  // Grey edges: colours must not differ where only the luminance does. The wide filter of blue and yellow reaches where
  // the narrow one of luminance has almost nothing.
  const auto edge = [](int at, float left, float right) {
    return picture(48, 40, [=](int x, int, int) { return x < at ? left : right; });
  };
  const auto flat = [](float v) { return fixtures::flat(48, 40, v, v, v); };
  const Image slope =
      picture(48, 40, [](int x, int y, int c) { return (x + y * (c + 1)) / 170.0; });
  const auto steeper = [&](double by) {
    return changed(slope, [by](float v) { return by * double(v); });
  };
  expect_accurate(
      {{"an edge, none", edge(24, 0, 1), flat(0), 0.5430131964, 0.9939436397},
       {"an edge beside", edge(24, 0, 1), edge(25, 0, 1), 0.06896337028, 0.7729164423},
       {"an edge, the other way", edge(24, 0, 1), edge(24, 1, 0), 0.9488872354, 0.9673797618},
       {"a weak edge", edge(24, 0.5f, 0.5f + 6e-8f), flat(0.5f), 4.566503506e-06, 9.01402724e-06},
       {"a slope, steeper", slope, steeper(1.01), 0.02890909189, 0.03528834363},
       {"a slope, a bit steeper", slope, steeper(1.000001), 4.217317046e-05, 5.278433367e-05}});
}

TEST(FlipAccuracy, IsAMillionthWherePicturesHaveEquallyStrongFeatures) {
  // Strengths are equal but for rounding, and the root of a difference is taken.
  const Image a = fixtures::noise(36, 36, 9, 1);
  const auto from = [&a](auto pixel_of) {
    return picture(36, 36, [&](int x, int y, int c) {
      const auto [u, v] = pixel_of(x, y);
      return a.pixel(u, v)[std::size_t(c)];
    });
  };
  const auto stripes = [](int dx, int dy) {
    return picture(36, 36,
                   [=](int x, int y, int) { return (x * dx + y * dy) / 4 % 2 ? 0.8 : 0.1; });
  };
  expect_accurate(
      {{"transposed", a, from([](int x, int y) { return std::pair(y, x); }), 0.3807508757,
        0.8638951685},
       {"mirrored", a, from([](int x, int y) { return std::pair(35 - x, y); }), 0.380276652,
        0.8555592706},
       {"turned", a, from([](int x, int y) { return std::pair(35 - x, 35 - y); }), 0.4212938267,
        0.9185887705},
       {"negative", a, changed(a, [](float v) { return 1 - v; }), 0.4345195167, 0.9672348155},
       {"stripes across, down", stripes(1, 0), stripes(0, 1), 0.5474199443, 0.9501203205},
       {"a checker, shifted", stripes(4, 4),
        changed(stripes(4, 4), [](float v) { return 0.9f - v; }), 0.00588221684, 0.3247322735}});
}

TEST(FlipAccuracy, IsAMillionthForHighDynamicRangeAtEveryExposure) {
  const auto bright = [](std::uint64_t seed) {
    // From 2^-20 to 2^20, with mantissas that a float holds.
    return changed(fixtures::noise(31, 23, seed, 1), [](float v) {
      const int power = int(40 * v);
      return std::ldexp(1 + (40 * v - float(power)), power - 20);
    });
  };
  Image a = bright(1);
  a.pixel(3, 3)[0] = 3e38f;
  a.pixel(9, 9)[1] = -5;
  const Image b = bright(2), near = changed(a, [](float v) { return 1.0001f * v; });
  expect_accurate({{"dark", a, b, 0.6209806571, 0.9789442789, 67, -12},
                   {"as it is", a, b, 0.5773286806, 0.9762256282, 67, 0},
                   {"light", a, b, 0.5128331247, 0.9823738441, 67, 6.5},
                   {"almost white", a, b, 0.008369226783, 0.3845037468, 67, 20},
                   {"near, almost black", a, near, 8.453256554e-05, 0.0004069770125, 67, -25},
                   {"near, dark", a, near, 0.0003673963937, 0.001444466549, 67, -12},
                   {"near", a, near, 0.0002632402554, 0.0008269231906, 67, 0},
                   {"near, light", a, near, 0, 0, 67, 20}});
}

}  // namespace
}  // namespace lobelia
