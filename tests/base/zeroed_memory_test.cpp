#include "base/pictures/image.hpp"
#include "tests/test.hpp"

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

}  // namespace
}  // namespace lobelia
