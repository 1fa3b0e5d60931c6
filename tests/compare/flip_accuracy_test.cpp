// FLIP's errors in float64, on pictures where float32 or a careless order of operations shows: powers of almost nothing and
// roots of differences that cancel. The figures are those of the paper's formulas in double, each pixel's windows one after
// the other, by a program that shares no code with ours.
#include <hwy/targets.h>

#include "compare/display_light.hpp"
#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/flip_kernels.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

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
