#include "base/system/error.hpp"
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

}  // namespace
}  // namespace lobelia
