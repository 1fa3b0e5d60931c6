#include "core/image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace lobelia {
namespace {

TEST(ZeroedMemory, IsZeroAtEverySizeAlsoWhereItWasUsedBefore) {
  for (const std::size_t bytes :
       {1ul, 4096ul, (4ul << 20) - 1, 4ul << 20, (4ul << 20) + 1, (6ul << 20) - 1, 12ul << 20})
    for (int again = 0; again < 3; ++again) {
      std::vector<std::uint8_t, ZeroedMemory<std::uint8_t>> memory(bytes);
      EXPECT_EQ(std::count(memory.begin(), memory.end(), 0), std::ptrdiff_t(bytes));
      std::fill(memory.begin(), memory.end(), std::uint8_t(255));
    }
}

TEST(ZeroedMemory, TooMuchIsAnExceptionAndNoCrash) {
  ZeroedMemory<float> memory;
  EXPECT_THROW(memory.allocate(SIZE_MAX / 2), std::bad_alloc);
  EXPECT_THROW(memory.allocate(SIZE_MAX / 4), std::bad_alloc);
}

TEST(Image, IsBlackAtFirstAndCopiesKeepTheirOwnValues) {
  Image image(1024, 700);
  for (const float v : image.values()) ASSERT_EQ(v, 0);
  image.pixel(1, 2)[0] = 5;
  Image copy = image;
  copy.pixel(1, 2)[1] = 7;
  EXPECT_EQ(image.pixel(1, 2)[1], 0);
  EXPECT_EQ(copy.pixel(1, 2)[0], 5);
  image = std::move(copy);
  EXPECT_EQ(image.pixel(1, 2)[1], 7);
}

}  // namespace
}  // namespace lobelia
