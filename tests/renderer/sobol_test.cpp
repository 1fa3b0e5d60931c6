#include "renderer/sobol.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lobelia {
namespace {

TEST(Sobol, SecondDimensionIsThatOfItsDirectionNumbers) {
  // Sobol's second primitive polynomial, x + 1, with m = 1: each direction number is the last one,
  // xored with its half.
  const auto by_direction_numbers = [](std::uint32_t index) {
    std::uint32_t direction = 1u << 31, result = 0;
    for (; index; index >>= 1, direction ^= direction >> 1)
      if (index & 1) result ^= direction;
    return result;
  };
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const std::uint32_t index = i < 50000 ? i : sobol::hash(i);
    ASSERT_EQ(sobol::reverse_bits(sobol::second_reversed(index)), by_direction_numbers(index));
  }
}

TEST(Sobol, EveryPairOfEveryPixelIsANetForEveryPowerOfTwo) {
  for (std::uint32_t pixel = 0; pixel < 50; ++pixel)
    for (std::uint32_t dimension = 0; dimension < 4; ++dimension)
      for (int m = 0; m <= 8; ++m)
        for (int a = 0; a <= m; ++a) {
          std::vector<int> cells(std::size_t{1} << m);
          for (std::uint32_t k = 0; k < cells.size(); ++k) {
            const auto [u, v] = sobol::pair(sobol::pixel_hash(pixel, 1), k, dimension);
            ASSERT_TRUE(u >= 0 && u < 1 && v >= 0 && v < 1);
            ++cells[(std::size_t(u * (1 << a)) << (m - a)) + std::size_t(v * (1 << (m - a)))];
          }
          ASSERT_TRUE(std::all_of(cells.begin(), cells.end(), [](int n) { return n == 1; }))
              << "pixel " << pixel << " dimension " << dimension << " m " << m << " a " << a;
        }
}

TEST(Sobol, PairsArePaddedIndependently) {
  // The correlation of one pair's first number with another's, over pixels and samples.
  double sum = 0;
  constexpr int kPixels = 4000, kSamples = 16;
  for (std::uint32_t p = 0; p < kPixels; ++p)
    for (std::uint32_t k = 0; k < kSamples; ++k) {
      const auto pixel = sobol::pixel_hash(p, 9);
      sum += (sobol::pair(pixel, k, 0).u - 0.5) * (sobol::pair(pixel, k, 1).u - 0.5);
    }
  // Of independent numbers the mean has a standard deviation of 1/12 over the root of their number.
  EXPECT_LT(std::abs(sum / (kPixels * kSamples)), 5.0 / 12 / std::sqrt(kPixels * kSamples));
}

TEST(Sobol, AnotherSeedOrPixelGivesOtherNumbers) {
  EXPECT_NE(sobol::pixel_hash(0, 0), sobol::pixel_hash(1, 0));
  EXPECT_NE(sobol::pixel_hash(0, 0), sobol::pixel_hash(0, 1));
  EXPECT_NE(sobol::pixel_hash(1, 0), sobol::pixel_hash(0, 1));
  EXPECT_NE(sobol::pixel_hash(std::uint64_t{1} << 32, 0), sobol::pixel_hash(0, 0));
}

}  // namespace
}  // namespace lobelia
