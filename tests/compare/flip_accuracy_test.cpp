// FLIP's errors against the formulas of the paper in float64, on pictures where float32 or a careless order of operations
// shows: powers of almost nothing and roots of differences that cancel.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cmath>
#include <string>

#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/flip_kernels.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/compare/plain_flip.hpp"
#include "tests/renderer/random_scene.hpp"

namespace lobelia {
namespace {

/// Measured: at most 2.6e-7 over all tests of this file, on every instruction set.
constexpr double kBound = 1e-6;

/// Of all pixels and instruction sets.
double largest_error(const DisplayLight& a, const DisplayLight& b, double pixels_per_degree) {
  const std::vector<double> plain = fixtures::plain_flip(a, b, pixels_per_degree);
  double largest = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    const PixelValues errors = flip_error_map(a, b, FlipFilters(pixels_per_degree));
    hwy::SetSupportedTargetsForTest(0);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const double error = std::abs(double(errors[i]) - plain[i]);
      if (std::isnan(error)) return error;
      largest = std::max(largest, error);
    }
  }
  return largest;
}

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

void expect_accurate(const std::string& name, const Image& a, const Image& b,
                     double pixels_per_degree = kDefaultPixelsPerDegree) {
  const double error = largest_error(DisplayLight(a, 0), DisplayLight(b, 0), pixels_per_degree);
  EXPECT_LT(error, kBound) << name;
  const double exchanged = largest_error(DisplayLight(b, 0), DisplayLight(a, 0), pixels_per_degree);
  EXPECT_LT(exchanged, kBound) << name << ", exchanged";
}

TEST(FlipAccuracy, IsAMillionthOnRandomPicturesAtRandomDistances) {
  Random random(7);
  for (int round = 0; round < 40; ++round) {
    const int width = int(random.between(1, 50)), height = int(random.between(1, 40));
    const double distance = std::exp(random.between(std::log(8.0), std::log(130.0)));
    const Image a = fixtures::noise(width, height, std::uint64_t(2 * round + 1),
                                    float(random.between(0.1, 1.5)));
    const Image other = fixtures::noise(width, height, std::uint64_t(2 * round + 2), 1.2f);
    // From nothing in common to almost equal.
    const double share = std::pow(10, random.between(-9, 0));
    Image b = a;
    for (std::size_t i = 0; i < b.values().size(); ++i)
      b.values()[i] =
          float((1 - share) * double(a.values()[i]) + share * double(other.values()[i]));
    expect_accurate(std::to_string(width) + " x " + std::to_string(height) + ", " +
                        std::to_string(distance) + " pixels per degree, share " +
                        std::to_string(std::log10(share)),
                    a, b, distance);
  }
}

TEST(FlipAccuracy, IsAMillionthOnFlatPictures) {
  const auto flat = [](float r, float g, float b) { return fixtures::flat(23, 9, r, g, b); };
  const Image black = flat(0, 0, 0), white = flat(1, 1, 1), grey = flat(0.2f, 0.2f, 0.2f);
  const float step = 1.0f / (1 << 24);
  expect_accurate("black, white", black, white);
  expect_accurate("grey, lighter", grey, flat(0.21f, 0.21f, 0.21f));
  expect_accurate("grey, a rounding lighter", grey, flat(0.2f + 2 * step, 0.2f, 0.2f + 2 * step));
  expect_accurate("white, almost white", white, flat(1 - step, 1 - step, 1 - step));
  expect_accurate("red, almost red", flat(1, 0, 0), flat(1 - step, 0, 0));
  expect_accurate("red, red with almost no green", flat(1, 0, 0), flat(1, 1e-12f, 0));
  expect_accurate("green, blue", flat(0, 1, 0), flat(0, 0, 1));
  expect_accurate("blue, cyan", flat(0, 0, 1), flat(0, 1, 1));
  expect_accurate("black, the smallest number", black, flat(1e-45f, 1e-45f, 1e-45f));
  expect_accurate("black, denormal", black, flat(1e-39f, 0, 3e-40f));
  for (const float dark : {1e-30f, 1e-20f, 1e-12f, 1e-8f, 1e-6f, 1e-4f})
    expect_accurate("black, " + std::to_string(std::log10(dark)), black,
                    flat(dark, dark, dark / 2));
  // Around the end of the straight part of Lab's curve.
  const float knee = 216.0f / 24389;
  for (const float below : {0.0f, 1e-9f, 1e-7f, 1e-4f})
    for (const float above : {0.0f, 2e-9f, 1e-7f, 1e-3f})
      expect_accurate("about the knee", flat(knee - below, knee - below, knee - below),
                      flat(knee + above, knee + above, knee + above));
}

// FLIP skips what is far from every difference. These pictures are several tiles, bands and blocks large.
TEST(FlipAccuracy, IsAMillionthOnPicturesThatDifferInAFewPlaces) {
  Random random(7);
  for (int round = 0; round < 24; ++round) {
    const int width = int(random.between(1, round % 2 == 0 ? 100 : 300)),
              height = int(random.between(1, 60));
    const double distance = std::exp(random.between(std::log(8.0), std::log(130.0)));
    const Image a = fixtures::noise(width, height, std::uint64_t(round), 1.1f);
    Image b = a;
    for (int places = int(random.between(1, 7)); places > 0; --places) {
      const int left = int(random.between(0, width)), top = int(random.between(0, height));
      const int right = std::min(width, left + int(random.between(1, 20))),
                bottom = std::min(height, top + int(random.between(1, 12)));
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) b.pixel(x, y)[std::size_t(random.between(0, 3))] += 0.1f;
    }
    expect_accurate(
        std::to_string(width) + " x " + std::to_string(height) + ", round " + std::to_string(round),
        a, b, distance);
  }
}

TEST(FlipAccuracy, IsAMillionthAroundOnePixel) {
  const Image flat = fixtures::flat(41, 33, 0.3f, 0.3f, 0.3f),
              noise = fixtures::noise(41, 33, 8, 1);
  for (const Image& a : {flat, noise})
    for (const auto& [x, y] : {std::pair(0, 0), {20, 16}, {40, 32}, {20, 0}})
      for (const float change : {0.5f, 1e-3f, 1e-6f, -0.2f}) {
        Image b = a;
        for (float& value : b.pixel(x, y)) value += change;
        expect_accurate("one pixel, " + std::to_string(change), a, b);
      }
}

TEST(FlipAccuracy, IsAMillionthOnEdges) {
  // Grey edges: colours must not differ where only the luminance does. The wide filter of blue and yellow reaches where
  // the narrow one of luminance has almost nothing.
  const auto edge = [](int at, float left, float right) {
    return picture(48, 40, [=](int x, int, int) { return x < at ? left : right; });
  };
  expect_accurate("an edge, none", edge(24, 0, 1), fixtures::flat(48, 40, 0, 0, 0));
  expect_accurate("an edge beside", edge(24, 0, 1), edge(25, 0, 1));
  expect_accurate("an edge, the other way", edge(24, 0, 1), edge(24, 1, 0));
  expect_accurate("a weak edge", edge(24, 0.5f, 0.5f + 6e-8f),
                  fixtures::flat(48, 40, 0.5f, 0.5f, 0.5f));
  const Image slope =
      picture(48, 40, [](int x, int y, int c) { return (x + y * (c + 1)) / 170.0; });
  expect_accurate("a slope, steeper", slope, changed(slope, [](float v) { return 1.01 * v; }));
  expect_accurate("a slope, a bit steeper", slope,
                  changed(slope, [](float v) { return 1.000001 * v; }));
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
  expect_accurate("transposed", a, from([](int x, int y) { return std::pair(y, x); }));
  expect_accurate("mirrored", a, from([](int x, int y) { return std::pair(35 - x, y); }));
  expect_accurate("turned", a, from([](int x, int y) { return std::pair(35 - x, 35 - y); }));
  expect_accurate("negative", a, changed(a, [](float v) { return 1 - v; }));
  const auto stripes = [](int dx, int dy) {
    return picture(36, 36,
                   [=](int x, int y, int) { return (x * dx + y * dy) / 4 % 2 ? 0.8 : 0.1; });
  };
  expect_accurate("stripes across, down", stripes(1, 0), stripes(0, 1));
  expect_accurate("a checker, shifted", stripes(4, 4),
                  changed(stripes(4, 4), [](float v) { return 0.9f - v; }));
}

TEST(FlipAccuracy, IsAMillionthForHighDynamicRangeAtEveryExposure) {
  const auto bright = [](std::uint64_t seed) {
    return changed(fixtures::noise(31, 23, seed, 1),
                   [](float v) { return std::exp2(40 * v - 20); });
  };
  Image a = bright(1);
  a.pixel(3, 3)[0] = 3e38f;
  a.pixel(9, 9)[1] = -5;
  const Image b = bright(2), near = changed(a, [](float v) { return 1.0001f * v; });
  for (const ToneCurve curve :
       {ToneCurve::kClip, ToneCurve::kAces, ToneCurve::kReinhard, ToneCurve::kHable})
    for (const double stops : {-25.0, -12.0, 0.0, 6.5, 20.0})
      for (const Image* other : {&b, &near})
        EXPECT_LT(
            largest_error(DisplayLight(a, stops, curve), DisplayLight(*other, stops, curve), 67),
            kBound)
            << stops;
}

}  // namespace
}  // namespace lobelia
