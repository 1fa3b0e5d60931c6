#include "compare/profile/blob.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/error.hpp"

namespace lobelia {
namespace {

Image image_of(int width, int height, const std::function<double(double x, double y)>& radiance) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double value = radiance(x + 0.5, y + 0.5);
      // Of another colour than grey: what counts is the mean.
      image.pixel(x, y)[0] = float(1.5 * value);
      image.pixel(x, y)[1] = float(value);
      image.pixel(x, y)[2] = float(0.5 * value);
    }
  return image;
}

constexpr double kBackground = 0.25, kPeak = 4, kMajor = 14, kMinor = 5, kTilt = 0.6;
constexpr FilmPoint kMiddle{81.37, 70.84};

/// A Gaussian of those half-widths.
double hill(double x, double y) {
  const double c = std::cos(kTilt), s = std::sin(kTilt), dx = x - kMiddle.x, dy = y - kMiddle.y;
  const double u = (c * dx + s * dy) / kMajor, v = (-s * dx + c * dy) / kMinor;
  return kPeak * std::exp2(-u * u - v * v);
}
Image tilted() {
  return image_of(170, 150, [](double x, double y) { return kBackground + hill(x, y); });
}

BlobProfiles blobs_of(const NamedImages& images, const BlobOptions& options = {}) {
  return measure_blobs(images, options);
}
/// The brightest one, against b if there are two pictures.
BlobProfile profile_of(const NamedImages& images) { return blobs_of(images).highlights.at(0); }
BlobFigures blob_of(const Image& image) { return profile_of({{"a", &image}}).blobs.at(0); }

TEST(Blob, OfATiltedGaussianHasItsFigures) {
  const BlobFigures blob = blob_of(tilted());
  EXPECT_EQ(blob.why_not + blob.remark, "");
  EXPECT_EQ(blob.peak.found, PeakFound::kFitted);
  EXPECT_NEAR(blob.peak.place.x, kMiddle.x, 0.02);
  EXPECT_NEAR(blob.peak.place.y, kMiddle.y, 0.02);
  EXPECT_NEAR(blob.axes.centre.x, kMiddle.x, 0.1);
  EXPECT_NEAR(blob.axes.centre.y, kMiddle.y, 0.1);
  EXPECT_NEAR(blob.background, kBackground, 1e-4 * kPeak);
  EXPECT_NEAR(blob.peak.value, kPeak, 1e-3 * kPeak);
  EXPECT_NEAR(blob.axes.major.x, std::cos(kTilt), 0.01);
  EXPECT_NEAR(blob.axes.major.y, std::sin(kTilt), 0.01);
  EXPECT_NEAR(blob.major_half_width, kMajor, 0.02);
  EXPECT_NEAR(blob.minor_half_width, kMinor, 0.02);
  EXPECT_NEAR(double(blob.pixels), std::numbers::pi * kMajor * kMinor, 5);
  const double energy = kPeak * std::numbers::pi * kMajor * kMinor / std::numbers::ln2;
  EXPECT_NEAR(blob.energy, energy, 0.005 * energy);
}

TEST(Blob, IsTheBrightestOfSeveral) {
  const BlobFigures blob = blob_of(image_of(200, 100, [](double x, double y) {
    return std::exp2(-(std::pow(x - 40, 2) + std::pow(y - 50, 2)) / 49) +
           1.2 * std::exp2(-(std::pow(x - 150, 2) + std::pow(y - 50, 2)) / 49);
  }));
  EXPECT_NEAR(blob.peak.place.x, 150, 0.01);
  EXPECT_NEAR(blob.major_half_width, 7, 0.05);
}

TEST(Blob, CurvesRunThroughThePeakOfTheReferenceAlongItsAxes) {
  const Image a = image_of(170, 150, [](double, double) { return 1; }), b = tilted();
  const BlobProfile profile = profile_of({{"a", &a}, {"b", &b}});
  ASSERT_EQ(profile.curves.size(), 2u);
  for (const auto& [curve, half] :
       {std::pair{profile.curves[0], kMajor}, {profile.curves[1], kMinor}})
    for (std::size_t k = 0; k < curve.offset.size(); ++k) {
      EXPECT_NEAR(curve.radiance[0][k], 1, 1e-6);
      EXPECT_NEAR(curve.radiance[1][k],
                  kBackground + kPeak * std::exp2(-std::pow(curve.offset[k] / half, 2)),
                  5e-3 * kPeak)
          << curve.axis << ' ' << curve.offset[k];
    }
  EXPECT_LT(profile.curves[0].offset.front(), -3.1 * kMajor);
}

TEST(Blob, PutsADifferenceIntoTheZoneOfTheReference) {
  const Image b = tilted();
  const auto with = [&](double from, double to) {
    return image_of(170, 150, [&](double x, double y) {
      const double share = hill(x, y) / kPeak;
      return kBackground + hill(x, y) + (share >= from && share < to ? 0.5 : 0);
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
    EXPECT_NEAR(zones[changed].max_rel_peak, 0.5 / kPeak, 1e-3);
  }
}

TEST(Blob, OfAPictureWithoutOneSaysWhy) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const int side : {1, 2, 40})
    for (const double value : {0.0, 1.0, -2.0}) {
      const BlobFigures blob = blob_of(image_of(side, side, [&](double, double) { return value; }));
      EXPECT_EQ(blob.why_not, "nothing stands out: no pixel is brighter than its surroundings");
      EXPECT_TRUE(std::isnan(blob.peak.value) && std::isnan(blob.energy));
    }
  const BlobFigures broken = blob_of(image_of(8, 8, [&](double, double) { return nan; }));
  EXPECT_EQ(broken.why_not, "no pixel is finite");
  EXPECT_EQ(broken.not_finite, 64u);
  const Image good = tilted();
  EXPECT_TRUE(profile_of({{"good", &good}, {"same", &good}}).difference.has_value());
  const Image empty(good.width(), good.height());
  const BlobProfile against = profile_of({{"good", &good}, {"empty", &empty}});
  EXPECT_EQ(against.curves.size(), 2u) << "along the axes of the only one";
  EXPECT_FALSE(against.difference.has_value());
  EXPECT_TRUE(against.blobs[1].why_not.starts_with("nothing stands out"));
}

TEST(Blob, OfASinglePixelIsNoneAndACutOneIsDoubted) {
  Image spike = image_of(60, 60, [](double, double) { return 0.1; });
  spike.pixel(20, 30)[1] = 9;
  EXPECT_EQ(blob_of(spike).why_not,
            "nothing stands out but a single pixel at (20.5, 30.5): a fault of the picture, or a "
            "highlight smaller than a pixel");
  for (const auto& [x, y] : {std::pair{21, 30}, {20, 31}, {21, 31}}) spike.pixel(x, y)[1] = 9;
  EXPECT_EQ(blob_of(spike).remark,
            "not resolved: 4 pixels are above half of the peak, 9 are needed");
  EXPECT_TRUE(std::isnan(blob_of(spike).major_half_width));
  EXPECT_EQ(
      blob_of(image_of(60, 60, [](double x, double y) { return std::exp(-(x + y) / 10); })).remark,
      "it is cut by the border of the picture");
}

TEST(Blob, LeavesOutPixelsThatAreNotFiniteAndCountsThem) {
  Image image = tilted();
  image.pixel(3, 3)[0] = std::numeric_limits<float>::infinity();
  image.pixel(4, 140)[1] = std::numeric_limits<float>::quiet_NaN();
  const BlobFigures blob = blob_of(image);
  EXPECT_EQ(blob.not_finite, 2u);
  EXPECT_NEAR(blob.peak.place.x, kMiddle.x, 0.02);
  // In the middle of the blob it is a hole beside which nothing can be fitted.
  image.pixel(81, 70)[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(blob_of(image).peak.found, PeakFound::kEdge);
}

TEST(Blob, RefusesTwoSizes) {
  const Image a(4, 5), b(5, 4);
  try {
    blobs_of({{"a", &a}, {"b", &b}});
    FAIL() << "it was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kInput);
    EXPECT_STREQ(error.what(), "a has 4 x 5 pixels, b has 5 x 4");
  }
}

}  // namespace
}  // namespace lobelia
