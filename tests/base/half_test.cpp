// Half floats against OpenEXR's.
#include <half.h>

#include "base/pictures/half.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using Exr = half;  // Imath's, of OpenEXR

constexpr int kAll = 1 << 16;

double from_bits(std::uint16_t bits) {
  Exr exr;
  exr.setBits(bits);
  return double(exr);
}

TEST(Half, KeepsEveryHalfFloat) {
  for (int i = 0; i < kAll; ++i) {
    const double value = from_bits(std::uint16_t(i));
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(rounded_to_half(value)));
    } else {
      ASSERT_EQ(rounded_to_half(value), value);
    }
  }
}

TEST(Half, RoundsEveryFloatAsOpenExrDoes) {
  std::mt19937 random(1);
  std::vector<float> values{0.0f,       -0.0f,        65504,        65519.996f, 65520,
                            -65520,     1e30f,        0x1p-24f,     0x1p-25f,   0x1.000002p-25f,
                            0x1.8p-24f, 0x1.ffcp-15f, 0x1.ffep-15f, 0x1p-14f,   1e-30f};
  for (int i = 0; i < kAll; ++i) {
    // The middle between two half floats, and the floats beside it.
    const auto bits = std::uint16_t(i);
    const float here = float(from_bits(bits)), next = float(from_bits(bits + 1));
    const float middle = here + (next - here) / 2;
    values.insert(values.end(),
                  {middle, std::nextafter(middle, 1e9f), std::nextafter(middle, -1e9f)});
  }
  for (int i = 0; i < 1'000'000; ++i)
    values.push_back(std::bit_cast<float>(std::uint32_t(random())));
  for (const float x : values) {
    if (std::isnan(x)) continue;
    const double rounded = rounded_to_half(x);
    ASSERT_EQ(rounded, double(Exr(x))) << x;
    ASSERT_EQ(std::signbit(rounded), std::signbit(x)) << x;
  }
}

TEST(Half, RoundsADoubleOnce) {
  // By way of float, each would be rounded to the middle first, and then to even.
  EXPECT_EQ(rounded_to_half(1 + 0x1p-11), 1);
  EXPECT_EQ(rounded_to_half(1 + 0x1p-11 + 0x1p-40), 1 + 0x1p-10);
  EXPECT_EQ(rounded_to_half(0x1p-25 + 0x1p-60), 0x1p-24);
  EXPECT_EQ(rounded_to_half(65520 - 0x1p-30), 65504);
}

}  // namespace
}  // namespace lobelia
