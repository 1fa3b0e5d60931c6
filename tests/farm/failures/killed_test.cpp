// A farm that is killed at any moment.
#include <signal.h>

#include <random>
#include <thread>

#include "failing_farm.hpp"

namespace lobelia {
namespace {

class KilledFarm : public FailingFarm {
 protected:
  void forget_everything() const {
    for (const auto& directory : {out(), cache()}) fs::remove_all(directory);
  }
  static std::vector<std::string> dying(const std::string& variable) {
    return {"LD_PRELOAD=" LOBELIA_DYING_CALLS, "ASAN_OPTIONS=verify_asan_link_order=0", variable};
  }
};

TEST_F(KilledFarm, AtAnyWriteLosesNothingButTheResultsThatWereNotThereYet) {
  undisturbed();
  const fs::path count_file = root() / "calls";
  ASSERT_EQ(run_command(command(), dying("COUNT_CALLS=" + count_file.string())).exit_code, 0);
  const int calls = std::stoi(read_file(count_file, 100));
  ASSERT_GT(calls, 100) << "each of these is a moment at which it may be killed";
  constexpr int kFirst = 8, kMoments = 20;
  std::size_t killed = 0;
  for (int i = 0; i < kMoments && !HasFailure(); ++i) {
    // Every one of the first, with which a cache begins; then evenly up to the last.
    const int at =
        i < kFirst ? i + 1 : kFirst + (i + 1 - kFirst) * (calls - kFirst) / (kMoments - kFirst);
    SCOPED_TRACE(fmt::format("killed at call {} of about {}", at, calls));
    forget_everything();
    const FarmRun first = run_command(command(), dying(fmt::format("DIE_AT={}", at)));
    killed += first.exit_code == 128 + SIGKILL ? 1 : 0;
    const std::size_t there = cached_pictures();
    expect_mended(run(), pictures() - there);
  }
  EXPECT_GE(killed, std::size_t(kMoments) - 4) << "the last calls may not come in every run";
}

TEST_F(KilledFarm, AtAnyMomentGoesOnFromWhatWasThere) {
  undisturbed();
  const auto before = std::chrono::steady_clock::now();
  ASSERT_EQ(run().exit_code, 0);
  const auto whole = std::chrono::steady_clock::now() - before;
  constexpr int kMoments = 8;
  for (int i = 0; i < kMoments && !HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("killed at {} of {}", i, kMoments));
    forget_everything();
    {
      RunningFarm farm(command(), root());
      std::this_thread::sleep_for(whole * (i + 1) / kMoments);
      farm.signal(SIGKILL);
      farm.wait();
    }
    const std::size_t there = cached_pictures();
    expect_mended(run(), pictures() - there);
  }
}

TEST_F(KilledFarm, AgainAndAgainEndsWhereOneThatWasLeftAloneDoes) {
  undisturbed();
  std::mt19937 random(1);
  for (int i = 0; i < 15; ++i) {
    RunningFarm farm(command(), root());
    std::this_thread::sleep_for(std::chrono::milliseconds(40 + random() % 100));
    farm.signal(SIGKILL);
    farm.wait();
  }
  expect_mended(run());
}

}  // namespace
}  // namespace lobelia
