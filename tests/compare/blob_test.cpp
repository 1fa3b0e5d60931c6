#include "base/pictures/colour.hpp"
#include "base/pictures/half.hpp"
#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "profile/contour.hpp"
#include "profile/peak.hpp"
#include "profile/stored_steps.hpp"
#include "tests/compare/spots.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

constexpr double kBackground = 0.25;
constexpr Spot kTilted{81.37, 70.84, 4, 14, 5, 0.6};

/// A coloured spot. The figures are those of the mean of its channels.
Image coloured(const Radiance& radiance) { return picture(170, 150, radiance, {1.5, 1, 0.5}); }
Image tilted() {
  return coloured([](double x, double y) { return kBackground + kTilted(x, y); });
}

/// The brightest one, against the last picture if there are two.
BlobProfile profile_of(const NamedImages& images) {
  return measure_blobs(images, {}).highlights.at(0);
}

TEST(Blob, HasTheFiguresOfATiltedGaussian) {
  const BlobFigures blob = first_of(tilted());
  EXPECT_EQ(blob.why_not + blob.remark, "");
  EXPECT_EQ(blob.peak.found, PeakFound::kFitted);
  EXPECT_NEAR(blob.peak.place.x, kTilted.x, 0.02);
  EXPECT_NEAR(blob.peak.place.y, kTilted.y, 0.02);
  EXPECT_NEAR(blob.axes.centre.x, kTilted.x, 0.1);
  EXPECT_NEAR(blob.axes.centre.y, kTilted.y, 0.1);
  EXPECT_NEAR(blob.background, kBackground, 1e-4 * kTilted.peak);
  EXPECT_NEAR(blob.peak.value, kTilted.peak, 1e-3 * kTilted.peak);
  EXPECT_NEAR(blob.axes.major.x, std::cos(kTilted.tilt), 0.01);
  EXPECT_NEAR(blob.axes.major.y, std::sin(kTilted.tilt), 0.01);
  EXPECT_NEAR(blob.major_half_width, kTilted.major, 0.02);
  EXPECT_NEAR(blob.minor_half_width, kTilted.minor, 0.02);
  EXPECT_NEAR(double(blob.pixels), std::numbers::pi * kTilted.major * kTilted.minor, 5);
  const double energy =
      kTilted.peak * std::numbers::pi * kTilted.major * kTilted.minor / std::numbers::ln2;
  EXPECT_NEAR(blob.energy, energy, 0.005 * energy);
}

TEST(Blob, CurvesRunThroughThePeakOfTheReferenceAlongItsAxes) {
  const Image a = picture(170, 150, [](double, double) { return 1; }), b = tilted();
  const BlobProfile profile = profile_of({{"a", &a}, {"b", &b}});
  ASSERT_EQ(profile.curves.size(), 2u);
  for (const auto& [axis, curve] : profile.curves)
    for (std::size_t k = 0; k < curve.offset_pixels.size(); ++k) {
      const double offset = curve.offset_pixels[k];
      const double half = axis == "major" ? kTilted.major : kTilted.minor;
      EXPECT_NEAR(curve.radiance[0].second[k], 1, 1e-6);
      EXPECT_NEAR(curve.radiance[1].second[k],
                  kBackground + kTilted.peak * std::exp2(-std::pow(offset / half, 2)),
                  5e-3 * kTilted.peak)
          << axis << ' ' << offset;
    }
  EXPECT_LT(profile.curves[0].second.offset_pixels.front(), -3.1 * kTilted.major);
}

TEST(Blob, PutsADifferenceIntoTheZoneOfTheReference) {
  const Image b = tilted();
  const auto with = [&](double from, double to) {
    return coloured([&](double x, double y) {
      const double share = kTilted(x, y) / kTilted.peak;
      return kBackground + kTilted(x, y) + (share >= from && share < to ? 0.5 : 0);
    });
  };
  const std::array<std::pair<double, double>, kZoneCount> inside = {
      {{0.6, 2}, {0.06, 0.4}, {0.003, 0.04}}};
  for (std::size_t changed = 0; changed < kZoneCount; ++changed) {
    const Image a = with(inside[changed].first, inside[changed].second);
    const auto zones = profile_of({{"a", &a}, {"b", &b}}).difference.value();
    for (std::size_t zone = 0; zone < kZoneCount; ++zone) {
      EXPECT_GT(zones[zone].pixels, 100u);
      EXPECT_NEAR(zones[zone].max_abs, zone == changed ? 0.5 : 0, 1e-6) << zone << ' ' << changed;
    }
    EXPECT_NEAR(zones[changed].max_rel_peak, 0.5 / kTilted.peak, 1e-3);
  }
}

TEST(Blob, SaysWhyAPictureHasNone) {
  for (const int side : {1, 2, 40})
    for (const double value : {0.0, 1.0, -2.0}) {
      const BlobFigures blob = first_of(picture(side, side, [&](double, double) { return value; }));
      EXPECT_EQ(blob.why_not, "nothing stands out: no pixel is brighter than its surroundings");
      EXPECT_TRUE(std::isnan(blob.peak.value) && std::isnan(blob.energy));
    }
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const BlobFigures broken = first_of(picture(8, 8, [&](double, double) { return value; }));
    EXPECT_EQ(broken.why_not, "no pixel is finite");
    EXPECT_EQ(broken.not_finite, 64u);
  }
  const Image good = tilted();
  EXPECT_TRUE(profile_of({{"good", &good}, {"same", &good}}).difference.has_value());
  const Image empty(good.width(), good.height());
  const BlobProfile against = profile_of({{"good", &good}, {"empty", &empty}});
  EXPECT_EQ(against.curves.size(), 2u) << "along the axes of the only one";
  EXPECT_FALSE(against.difference.has_value());
  EXPECT_TRUE(against.blobs[1].why_not.starts_with("nothing stands out"));
}

TEST(Blob, IsNoneOnASinglePixelAndDoubtedWhereItIsCut) {
  Image spike = picture(60, 60, [](double, double) { return 0.1; });
  spike.pixel(20, 30)[1] = 9;
  EXPECT_EQ(first_of(spike).why_not,
            "nothing stands out but a single pixel at (20.5, 30.5): a fault of the picture, or a "
            "highlight smaller than a pixel");
  for (const auto& [x, y] : {std::pair{21, 30}, {20, 31}, {21, 31}}) spike.pixel(x, y)[1] = 9;
  EXPECT_EQ(first_of(spike).remark,
            "not resolved: 4 pixels are above half of the peak, 9 are needed");
  EXPECT_TRUE(std::isnan(first_of(spike).major_half_width));
  EXPECT_EQ(
      first_of(picture(60, 60, [](double x, double y) { return std::exp(-(x + y) / 10); })).remark,
      "it is cut by the border of the picture");
}

TEST(Blob, CountsPixelsWithoutAFiniteValue) {
  Image image = tilted();
  image.pixel(3, 3)[0] = std::numeric_limits<float>::infinity();
  image.pixel(4, 140)[1] = std::numeric_limits<float>::quiet_NaN();
  const BlobFigures blob = first_of(image);
  EXPECT_EQ(blob.not_finite, 2u);
  EXPECT_NEAR(blob.peak.place.x, kTilted.x, 0.02);
  // In the middle of the blob it is a hole beside which nothing can be fitted.
  image.pixel(81, 70)[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(first_of(image).peak.found, PeakFound::kEdge);
}

TEST(Blob, RefusesTwoSizes) {
  const Image a(4, 5), b(5, 4);
  const auto measure = [&] { measure_blobs({{"a", &a}, {"b", &b}}, {}); };
  EXPECT_EQ(error_words(ExitCode::kInput, measure), "a has 4 x 5 pixels, b has 5 x 4");
}

// Regions of highlights to a fraction of a pixel, and the steps of the numbers in a picture's file.

TEST(Contour, HasTheCentreAndTheAreaOfAHighlightWhereverItLies) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any;
  for (int k = 0; k < 50; ++k) {
    const double minor = 2 + 6 * any(random), major = minor * (1 + any(random));
    const Spot spot{30 + any(random), 30 + any(random), 2, major, minor, 3 * any(random)};
    const Field field = radiance_field(picture(60, 60, spot));
    const std::size_t brightest = locate_peak(field).pixel;
    const auto parts = parts_above(field, region_above(field, brightest, 1), 1);
    const Axes axes = principal_axes(parts);
    // Whole pixels are off by up to 0.1.
    EXPECT_NEAR(axes.centre.x, spot.x, 0.01) << minor;
    EXPECT_NEAR(axes.centre.y, spot.y, 0.01) << minor;
    double area = 0;
    for (const ContourPart& part : parts) area += part.area;
    EXPECT_NEAR(area / (std::numbers::pi * major * minor), 1, 0.02) << minor;
  }
}

TEST(Contour, TakesPixelsBesideAHoleAsAWhole) {
  const Spot spot{10.2, 10.4, 2, 4, 4};
  Image image = picture(20, 20, spot);
  image.pixel(8, 10)[0] = std::numeric_limits<float>::quiet_NaN();
  const Field field = radiance_field(image);
  const auto parts = parts_above(field, region_above(field, locate_peak(field).pixel, 1), 1);
  ASSERT_FALSE(parts.empty());
  for (const ContourPart& part : parts) {
    EXPECT_TRUE(std::isfinite(part.value) && part.area <= 1);
    EXPECT_NE(std::pair(int(part.place.x), int(part.place.y)), std::pair(8, 10));
  }
}

TEST(StoredSteps, AreFoundFromTheValuesOfAPicture) {
  const Spot spot{20.3, 20.8, 0.9, 6, 5};
  const auto stored = [&](double (*round)(double)) {
    return StoredSteps(picture(40, 40, [&](double x, double y) { return round(spot(x, y)); }));
  };
  EXPECT_NEAR(stored([](double v) { return std::round(255 * v) / 255; }).at(0.5), 1.0 / 255, 1e-9);
  EXPECT_NEAR(stored([](double v) { return std::round(65535 * v) / 65535; }).at(0.5), 1.0 / 65535,
              1e-9);
  EXPECT_NEAR(stored(rounded_to_half).at(0.75), 0x1p-11, 1e-12);
  EXPECT_NEAR(stored(rounded_to_half).at(1e-9), 0x1p-24, 1e-12) << "among the smallest numbers";
  EXPECT_NEAR(stored([](double v) { return v; }).at(0.75), 0x1p-24, 1e-12);
  const StoredSteps srgb =
      stored([](double v) { return double(srgb_decoded(float(std::round(200 * v) / 255))); });
  for (const int code : {3, 40, 128, 220}) {
    const double value = double(srgb_decoded(float(code) / 255));
    const double step = double(srgb_decoded(float(code + 1) / 255)) - value;
    EXPECT_NEAR(srgb.at(value), step, 0.03 * step) << code;
  }
}

TEST(StoredSteps, WidenTheErrorsOfAPictureOfFewBits) {
  const Spot spot{60.3, 55.1, 0.8, 9, 7};
  const auto errors = [&](double (*round)(double)) {
    return first_of(picture(120, 110, [&](double x, double y) { return round(0.1 + spot(x, y)); }))
        .errors;
  };
  const BlobErrors exact = errors([](double v) { return v; });
  const BlobErrors coarse = errors([](double v) { return std::round(255 * v) / 255; });
  // The background may be off by half a step, and so is everything over it.
  EXPECT_GT(coarse.background, 0.2 / 255);
  EXPECT_LT(coarse.background, 1.0 / 255);
  EXPECT_GT(coarse.energy, 5 * exact.energy);
}

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
