// Half floats against the compiler's own and OpenEXR's.
#include <half.h>

#include "base/pictures/half.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using Exr = half;  // Imath's, of OpenEXR

constexpr int kAll = 1 << 16;

std::uint16_t bits_of(Half value) { return Exr(float(value)).bits(); }
Half from_bits(std::uint16_t bits) {
  Exr exr;
  exr.setBits(bits);
  return Half(double(exr));
}

bool same(Half a, Half b) {
  return bits_of(a) == bits_of(b) || (std::isnan(double(a)) && std::isnan(double(b)));
}

TEST(Half, HasEveryValueThereAndBack) {
  for (int i = 0; i < kAll; ++i) {
    const auto bits = std::uint16_t(i);
    Exr exr;
    exr.setBits(bits);
    const Half value{double(exr)};
    if (exr.isNan()) {
      EXPECT_TRUE(std::isnan(double(value)));
      continue;
    }
    ASSERT_EQ(float(value), float(exr));
    ASSERT_EQ(bits_of(value), bits);
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
    ASSERT_EQ(bits_of(Half(x)), Exr(x).bits()) << x;
  }
}

TEST(Half, RoundsADoubleOnce) {
  // By way of float, each would be rounded to the middle first, and then to even.
  EXPECT_EQ(double(Half(1 + 0x1p-11)), 1);
  EXPECT_EQ(double(Half(1 + 0x1p-11 + 0x1p-40)), 1 + 0x1p-10);
  EXPECT_EQ(double(Half(0x1p-25 + 0x1p-60)), 0x1p-24);
  EXPECT_EQ(double(Half(65520 - 0x1p-30)), 65504);
}

TEST(Half, HasNoSubnormalsWhereTheyAreFlushed) {
  EXPECT_EQ(double(Half(0x1p-15)), 0x1p-15);
  EXPECT_EQ(double(FlushedHalf(0x1p-15)), 0);
  EXPECT_EQ(double(FlushedHalf(0x1p-7) * FlushedHalf(0x1p-8)), 0);
  EXPECT_EQ(double(FlushedHalf(0x1p-7) * FlushedHalf(0x1p-7)), 0x1p-14);
}

#ifdef __FLT16_MANT_DIG__

_Float16 of_compiler(Half a) { return std::bit_cast<_Float16>(bits_of(a)); }
Half from_compiler(_Float16 a) { return from_bits(std::bit_cast<std::uint16_t>(a)); }

// One operation each: between two of them GCC 12 may keep more digits.
void expect_the_compilers(Half a, Half b) {
  const _Float16 x = of_compiler(a), y = of_compiler(b);
  const auto text = [&](char sign) { return testing::Message() << double(a) << sign << double(b); };
  const _Float16 sum = x + y, difference = x - y, product = x * y, quotient = x / y;
  const auto root = _Float16(std::sqrt(float(x)));
  ASSERT_TRUE(same(a + b, from_compiler(sum))) << text('+');
  ASSERT_TRUE(same(a - b, from_compiler(difference))) << text('-');
  ASSERT_TRUE(same(a * b, from_compiler(product))) << text('*');
  ASSERT_TRUE(same(a / b, from_compiler(quotient))) << text('/');
  ASSERT_TRUE(same(sqrt(a), from_compiler(root))) << text('r');
  ASSERT_EQ(a < b, x < y) << text('<');
  ASSERT_EQ(a == b, x == y) << text('=');
}

TEST(HalfArithmetic, IsTheCompilers) {
  std::mt19937 random(2);
  const auto any = [&] { return from_bits(std::uint16_t(random())); };
  for (int i = 0; i < 2'000'000; ++i) ASSERT_NO_FATAL_FAILURE(expect_the_compilers(any(), any()));
  std::vector<Half> edges;
  for (const int bits :
       {0x0000, 0x0001, 0x0002, 0x03ff, 0x0400, 0x0401, 0x07ff, 0x1400, 0x2e66, 0x3555,
        0x37ff, 0x3800, 0x3bff, 0x3c00, 0x3c01, 0x3c02, 0x3fff, 0x4000, 0x4200, 0x5bff,
        0x63ff, 0x6400, 0x77ff, 0x7800, 0x7bfe, 0x7bff, 0x7c00, 0x7e00})
    for (const int sign : {0, 0x8000}) edges.push_back(from_bits(std::uint16_t(bits | sign)));
  for (const Half a : edges) {
    for (const Half b : edges) ASSERT_NO_FATAL_FAILURE(expect_the_compilers(a, b));
    for (int i = 0; i < kAll; ++i)
      ASSERT_NO_FATAL_FAILURE(expect_the_compilers(a, from_bits(std::uint16_t(i))));
  }
}

#endif

}  // namespace
}  // namespace lobelia
