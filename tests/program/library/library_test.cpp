// The public library returns what the rooms compute. tests/packages/library_test.cpp tests an installed library.
#include "lobelia/lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// A Gaussian highlight that is `major` pixels wide and `minor` high, at half of its peak, which is `peak`.
Picture highlight(double major, double minor, float peak) {
  Picture picture{96, 64, {}};
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double u = (x - 48) / major, v = (y - 32) / minor;
      const float value = peak * float(std::exp2(-u * u - v * v));
      picture.rgb.insert(picture.rgb.end(), {value, value, value});
    }
  return picture;
}

TEST(Library, TakesTheDefaultLimitsUnlessTurnedOff) {
  const Picture dim = highlight(8, 8, 1), bright = highlight(8, 8, 1.1f);
  CompareSettings settings;
  settings.limits = {{"max_rel_peak", 0.2}};
  EXPECT_GT(compare(bright, dim, settings).limits.size(), 1u);
  EXPECT_FALSE(compare(bright, dim, settings).pass);
  settings.default_limits = false;
  EXPECT_EQ(compare(bright, dim, settings).limits.size(), 1u);
  EXPECT_TRUE(compare(bright, dim, settings).pass);
}

TEST(Library, KnowsTheLongerHalfWidthOfAHighlightFromTheShorter) {
  const Profile found = profile(highlight(12, 5, 2));
  ASSERT_EQ(found.highlights.size(), 1u);
  const Highlight& one = found.highlights[0];
  EXPECT_NEAR(one.x, 48.5, 0.6);
  EXPECT_NEAR(one.y, 32.5, 0.6);
  EXPECT_NEAR(one.peak, 2, 0.02);
  EXPECT_NEAR(one.major_half_width, 12, 0.2);
  EXPECT_NEAR(one.minor_half_width, 5, 0.2);
}

}  // namespace
}  // namespace lobelia
