#include "renderer/sobol.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

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
  // The mean of independent numbers has a standard deviation of 1/12 over the root of their number.
  EXPECT_LT(std::abs(sum / (kPixels * kSamples)), 5.0 / 12 / std::sqrt(kPixels * kSamples));
}

}  // namespace
}  // namespace lobelia
