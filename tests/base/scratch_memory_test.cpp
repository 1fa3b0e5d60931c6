#include "base/system/scratch_memory.hpp"

#include <thread>

#include "base/pictures/image.hpp"
#include "base/system/files.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using Memory = std::vector<std::uint8_t, ZeroedMemory<std::uint8_t>>;

constexpr std::size_t kSmall = std::size_t{4} << 20, kAllOfThem = std::size_t{1} << 30;

class ScratchMemory : public ::testing::Test {
 protected:
  void SetUp() override { keep_large_pieces_in_files(kSmall); }
  void TearDown() override {
    keep_large_pieces_in_files(0);
    ::unsetenv("TMPDIR");
  }
};

std::size_t kibibytes_of_files_in_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (std::size_t size; word == "RssFile:" && status >> size) return size;
  return 0;
}

TEST_F(ScratchMemory, KeepsItsContentOutsideOfMemory) {
  for (const std::size_t bytes : {kSmall - 1, kSmall, kSmall + 1, 7 * kSmall + 12345}) {
    Memory memory(bytes);
    EXPECT_EQ(std::count(memory.begin(), memory.end(), 0), std::ptrdiff_t(bytes));
    for (std::size_t i = 0; i < bytes; ++i) memory[i] = std::uint8_t(i * 7 % 251);
    looked_at(kAllOfThem);
    for (std::size_t i = 0; i < bytes; ++i) ASSERT_EQ(memory[i], i * 7 % 251) << i;
  }
}

TEST_F(ScratchMemory, HoldsSmallPiecesBesideALargePicture) {
  keep_large_pieces_in_files(16 * kSmall);
  const auto leaves_memory = [] {
    const Memory part(kSmall, 1);
    const std::size_t before = kibibytes_of_files_in_memory();
    looked_at(kAllOfThem);
    return before > kibibytes_of_files_in_memory() + kSmall / 2048;
  };
  EXPECT_FALSE(leaves_memory());
  std::optional<Memory> kept;
  {
    const Memory picture(16 * kSmall);
    EXPECT_TRUE(leaves_memory());
    kept.emplace(kSmall);
  }
  EXPECT_FALSE(leaves_memory());
}

TEST_F(ScratchMemory, IsTheSameWhileManyThreadsWriteAndLetGo) {
  constexpr std::size_t kThreads = 4;
  Memory memory(4 * kSmall);
  {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < kThreads; ++t)
      threads.emplace_back([&, t] {
        for (std::size_t i = t; i < memory.size(); i += kThreads) {
          memory[i] = std::uint8_t(i % 241 + 1);
          if (i % 65536 == t) looked_at(kAllOfThem);
        }
      });
  }
  for (std::size_t i = 0; i < memory.size(); ++i) ASSERT_EQ(memory[i], i % 241 + 1) << i;
}

TEST_F(ScratchMemory, IsOrdinaryWhereTheDirectoryTakesNoFile) {
  ::setenv("TMPDIR", "/proc/self", 1);
  Memory memory(2 * kSmall, 3);
  looked_at(kAllOfThem);
  EXPECT_EQ(std::count(memory.begin(), memory.end(), 3), std::ptrdiff_t(memory.size()));
}

TEST_F(ScratchMemory, LeavesNoNameBehind) {
  const TemporaryDirectory directory;
  ::setenv("TMPDIR", directory.path().c_str(), 1);
  const Memory memory(2 * kSmall, 3);
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST(InParts, CoversEachElementOnceInOrder) {
  for (const std::size_t count : {0ul, 1ul, 196607ul, 196608ul, 196609ul, 1000000ul}) {
    std::size_t next = 0;
    in_parts(count, 1, [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(begin, next);
      EXPECT_LT(begin, end);
      next = end;
    });
    EXPECT_EQ(next, count);
  }
}

}  // namespace
}  // namespace lobelia
