// A change of speed that is found, and noise that is not.
#include "tests/bench/paired_times.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using Verdict = PairedChange::Verdict;

/// Times of a machine whose speed wanders, with noise that is sometimes large, as times are.
struct Machine {
  std::mt19937_64 random;
  double speed = 1;
  double seconds(double work) {
    std::lognormal_distribution<double> noise(0, 0.03);
    std::bernoulli_distribution is_disturbed(0.05);
    return work * speed * noise(random) * (is_disturbed(random) ? 1.5 : 1);
  }
  PairedChange measured(double old_work, double new_work, int rounds) {
    std::vector<double> old_times, new_times;
    for (int i = 0; i < rounds; ++i) {
      speed *= std::lognormal_distribution<double>(0, 0.1)(random);
      old_times.push_back(seconds(old_work));
      new_times.push_back(seconds(new_work));
    }
    return paired_change(old_times, new_times);
  }
};

TEST(PairedChange, IsFoundIfLargerThanTheNoise) {
  Machine machine{std::mt19937_64(20261127)};
  int false_alarms = 0, slower = 0, faster = 0;
  constexpr int kTrials = 2000;
  for (int i = 0; i < kTrials; ++i) {
    false_alarms += machine.measured(1, 1, 21).verdict != Verdict::kNoneFound;
    slower += machine.measured(1, 1.15, 21).verdict == Verdict::kSlower;
    faster += machine.measured(1.15, 1, 21).verdict == Verdict::kFaster;
  }
  EXPECT_LE(false_alarms, kTrials * 0.006);  // twice what is stated
  EXPECT_GE(slower, kTrials * 0.95);
  EXPECT_GE(faster, kTrials * 0.95);
}

TEST(PairedChange, HasItsRatioWithinItsBoundsForAnyNumberOfPairs) {
  Machine machine{std::mt19937_64(1)};
  for (int rounds = int(kLeastPairs); rounds <= 1000; rounds = rounds * 5 / 4 + 1) {
    const PairedChange change = machine.measured(1, 1, rounds);
    EXPECT_LE(change.least, change.ratio) << rounds;
    EXPECT_GE(change.most, change.ratio) << rounds;
  }
}

TEST(PairedChange, IsRefusedForPairsThatAreTooFewOrDoNotPair) {
  const std::vector<double> few(kLeastPairs - 1, 1.0), enough(kLeastPairs, 1.0);
  EXPECT_THROW(paired_change(few, few), std::invalid_argument);
  EXPECT_THROW(paired_change(enough, few), std::invalid_argument);
  EXPECT_EQ(paired_change(enough, enough).verdict, Verdict::kNoneFound);
}

}  // namespace
}  // namespace lobelia
