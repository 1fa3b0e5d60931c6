#include "base/pictures/colour.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

double srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Image grey(float value) {
  Image image(1, 1);
  for (float& v : image.values()) v = value;
  return image;
}

TEST(Display, EncodesSrgbAndClips) {
  for (const float value : {0.0f, 0.001f, 0.0031f, 0.02f, 0.18f, 0.5f, 0.99f, 1.0f})
    EXPECT_NEAR(to_display(grey(value), 0).rgb[0], 255 * srgb(value), 0.51) << value;
  EXPECT_EQ(to_display(grey(7), 0).rgb[0], 255);
  EXPECT_EQ(to_display(grey(-7), 0).rgb[0], 0);
}

TEST(Display, ExposureIsInStops) {
  EXPECT_EQ(to_display(grey(2), -2).rgb, to_display(grey(0.5), 0).rgb);
  EXPECT_EQ(to_display(grey(163), exposure_for_peak(163)).rgb[0], 255);
  EXPECT_EQ(exposure_for_peak(0), 0);
  EXPECT_EQ(exposure_for_peak(std::numeric_limits<double>::infinity()), 0);
}

TEST(Display, ShowsNonfinitePixelsInMagenta) {
  Image image = grey(0.5);
  image.values()[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(to_display(image, 0).rgb, (std::vector<std::uint8_t>{255, 0, 255}));
}

TEST(Srgb, DecodingUndoesEncoding) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(to_display(grey(srgb_decoded(float(code) / 255)), 0).rgb[0], code);
  }
}

}  // namespace
}  // namespace lobelia
