#include "profile/peak.hpp"
#include "base/words/constants.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

Field field_of(int width, int height, const std::function<double(double x, double y)>& value) {
  Field field{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) field.values.push_back(value(x + 0.5, y + 0.5));
  return field;
}

/// cos^n of the angle between the mirror direction and a light, on a sphere seen from far away: `radius` pixels,
/// centred on (cx, cy). The light stands so that the highlight's normal leans by `lean` along the picture's
/// direction (3, -4) / 5.
struct SphereLobe {
  double radius, cx, cy, lean, n;

  FilmPoint peak() const {
    return {cx + 0.6 * radius * std::sin(lean), cy - 0.8 * radius * std::sin(lean)};
  }
  double operator()(double x, double y) const {
    const double u = (x - cx) / radius, v = (y - cy) / radius, w2 = 1 - u * u - v * v;
    if (!(w2 > 0)) return kNaN;
    const double w = std::sqrt(w2), h = std::sin(2 * lean);
    // R = 2 (N.V) N - V with V = (0, 0, 1).
    const double rx = 2 * w * u - 0.6 * h, ry = 2 * w * v + 0.8 * h;
    const double rz = 2 * w2 - 1 - std::cos(2 * lean);
    const double s = (rx * rx + ry * ry + rz * rz) / 2;
    return s < 1 ? std::exp(n * std::log1p(-s)) : 0;
  }
};

TEST(Peak, LiesWithinAFiftiethOfAPixelOfWhereTheLobeHasIt) {
  for (const double n : {8.0, 32.0, 128.0, 512.0, 2048.0, 8192.0})
    for (const double lean : {0.0, 0.2, 0.4, 0.7})
      for (const double offset : {0.0, 0.21, 0.5, 0.83}) {
        const SphereLobe lobe{100, 120 + offset, 120 - offset / 3, lean, n};
        const Peak peak = locate_peak(field_of(240, 240, lobe));
        EXPECT_EQ(peak.found, PeakFound::kFitted) << n;
        EXPECT_NEAR(peak.place.x, lobe.peak().x, 0.02) << n << ' ' << lean << ' ' << offset;
        EXPECT_NEAR(peak.place.y, lobe.peak().y, 0.02) << n << ' ' << lean << ' ' << offset;
        EXPECT_NEAR(peak.value, 1, 0.01) << n << ' ' << lean;
      }
}

TEST(Peak, IsHeldByManyPixelsWhereThereIsNoise) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const SphereLobe lobe{100, 120.3, 119.6, 0.4, 64};
  double squares = 0;
  constexpr int kPictures = 100;
  for (int k = 0; k < kPictures; ++k) {
    const Peak peak = locate_peak(field_of(
        240, 240, [&](double x, double y) { return lobe(x, y) * (1 + 0.01 * normal(random)); }));
    ASSERT_EQ(peak.found, PeakFound::kFitted);
    squares +=
        std::pow(peak.place.x - lobe.peak().x, 2) + std::pow(peak.place.y - lobe.peak().y, 2);
  }
  // Measured: 0.10; of the brightest pixel 0.76.
  EXPECT_LT(std::sqrt(squares / kPictures), 0.15);
}

TEST(Peak, IsTheMiddleOfThePlateauOfAClippedHighlight) {
  const SphereLobe lobe{100, 120.3, 119.6, 0, 64};
  for (const double clip : {0.9, 0.5, 0.05}) {
    const Peak peak = locate_peak(field_of(
        240, 240, [&](double x, double y) { return lobe(x, y) > clip ? clip : lobe(x, y); }));
    EXPECT_EQ(peak.found, PeakFound::kPlateau) << clip;
    EXPECT_NEAR(peak.place.x, lobe.peak().x, 0.15) << clip;
    EXPECT_NEAR(peak.place.y, lobe.peak().y, 0.15) << clip;
    EXPECT_EQ(peak.value, clip);
  }
}

TEST(Peak, IsTheBrightestPixelAtTheBorderOrBesideAHole) {
  const Peak border = locate_peak(field_of(20, 20, [](double x, double) { return x; }));
  EXPECT_EQ(border.found, PeakFound::kPlateau) << "a whole column of it";
  const Peak corner = locate_peak(field_of(20, 20, [](double x, double y) { return x + 2 * y; }));
  EXPECT_EQ(corner.found, PeakFound::kEdge);
  EXPECT_EQ(corner.place.x, 19.5);
  EXPECT_EQ(corner.place.y, 19.5);
  // A terminator cuts through the lobe, left of its middle.
  const SphereLobe lobe{100, 120.3, 119.6, 0, 64};
  const Peak cut = locate_peak(
      field_of(240, 240, [&](double x, double y) { return x > 115 ? kNaN : lobe(x, y); }));
  EXPECT_EQ(cut.found, PeakFound::kEdge);
  EXPECT_EQ(cut.place.x, 114.5);
}

TEST(Peak, IsTheOneBrightPixel) {
  const Peak peak = locate_peak(
      field_of(9, 9, [](double x, double y) { return x == 3.5 && y == 4.5 ? 7.0 : 0.0; }));
  EXPECT_EQ(peak.found, PeakFound::kPixel);
  EXPECT_EQ(peak.place.x, 3.5);
  EXPECT_EQ(peak.place.y, 4.5);
  EXPECT_EQ(peak.value, 7);
  EXPECT_EQ(peak.pixel, 4u * 9 + 3);
}

TEST(Peak, IsNoneInABlackPicture) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double value : {0.0, -1.0, std::nan(""), infinity, -infinity}) {
    const Peak peak = locate_peak(field_of(3, 3, [&](double, double) { return value; }));
    EXPECT_EQ(peak.found, PeakFound::kNone) << value;
    EXPECT_TRUE(std::isnan(peak.place.x) && std::isnan(peak.value)) << value;
  }
  EXPECT_EQ(locate_peak(field_of(1, 1, [](double, double) { return 1; })).found, PeakFound::kEdge);
  EXPECT_EQ(locate_peak(field_of(9, 9, [](double, double) { return 1; })).found,
            PeakFound::kPlateau);
}

TEST(FieldSample, IsExactForAQuadraticAndNaNBesideAHole) {
  const auto value = [](double x, double y) { return 1 + x - 2 * y + 0.5 * x * x - x * y; };
  Field field = field_of(8, 8, value);
  for (const double x : {3.5, 3.9, 4.2})
    for (const double y : {2.5, 3.1, 4.49}) EXPECT_NEAR(sample(field, {x, y}), value(x, y), 1e-12);
  EXPECT_TRUE(std::isnan(sample(field, {1.2, 4}))) << "its neighbours are not all there";
  EXPECT_TRUE(std::isnan(sample(field, {-3, 4})));
  EXPECT_TRUE(std::isnan(sample(field, {1e300, kNaN})));
  EXPECT_EQ(sample(field, {0.5, 0.5}), value(0.5, 0.5));
  field.values[4 * 8 + 4] = kNaN;
  EXPECT_TRUE(std::isnan(sample(field, {3.4, 3.4})));
}

TEST(FieldRegion, HangsTogetherByCornersAndStopsAtHoles) {
  Field field = field_of(6, 3, [](double, double) { return 0; });
  field.values[0] = field.values[7] = field.values[14] = 2;  // a diagonal
  field.values[17] = 2;                                      // apart
  field.values[9] = kNaN;
  EXPECT_EQ(region_above(field, 0, 1).size(), 3u);
  EXPECT_EQ(region_above(field, 17, 1).size(), 1u);
  EXPECT_EQ(region_above(field, 0, 0).size(), 17u);
}

}  // namespace
}  // namespace lobelia
