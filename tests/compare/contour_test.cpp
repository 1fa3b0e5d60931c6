// Regions of highlights to a fraction of a pixel, and the steps of the numbers in a picture's file.
#include "profile/contour.hpp"

#include "base/pictures/colour.hpp"
#include "base/pictures/half.hpp"
#include "profile/stored_steps.hpp"
#include "tests/compare/spots.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

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

}  // namespace
}  // namespace lobelia
