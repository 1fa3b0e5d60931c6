#include "base/system/for_each_whole.hpp"
#include "tests/test.hpp"

#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace lobelia {
namespace {

constexpr int kThreads = 4;

TEST(ForEachWhole, DoesEveryStepOnce) {
  for (const std::size_t count : {0, 1, 2, 1000}) {
    std::vector<int> done(count);
    for_each_whole(count, [&](std::size_t i) { ++done[i]; });
    EXPECT_EQ(done, std::vector<int>(count, 1));
  }
}

TEST(ForEachWhole, EndsNoLoopOfAnotherStepWhenOneThrows) {
  oneapi::tbb::task_arena arena(kThreads);
  for (int round = 0; round < 30; ++round) {
    std::atomic<int> begun = 0, half_made = 0;
    const auto step = [&](std::size_t i) {
      if (i == 0) {
        // Fails once another step is at work; alone on a slow machine, after a while.
        for (int wait = 0; begun == 0 && wait < 200; ++wait)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        throw std::runtime_error("step 0");
      }
      ++begun;
      std::vector<char> made(5000);
      oneapi::tbb::this_task_arena::isolate([&] {
        oneapi::tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t k) {
          if (k % 100 == 0) std::this_thread::sleep_for(std::chrono::microseconds(50));
          made[k] = 1;
        });
      });
      half_made += std::ranges::count(made, 0) > 0;
    };
    std::string thrown;
    arena.execute([&] {
      try {
        for_each_whole(8, step);
      } catch (const std::runtime_error& error) {
        thrown = error.what();
      }
    });
    EXPECT_EQ(thrown, "step 0");
    EXPECT_EQ(half_made, 0);
  }
}

TEST(ForEachWhole, BeginsNoMoreStepsAfterOneHasThrown) {
  oneapi::tbb::task_arena alone(1);
  int begun = 0;
  alone.execute([&] {
    EXPECT_THROW(for_each_whole(100,
                                [&](std::size_t) {
                                  ++begun;
                                  throw std::runtime_error("");
                                }),
                 std::runtime_error);
  });
  EXPECT_EQ(begun, 1);
}

}  // namespace
}  // namespace lobelia
