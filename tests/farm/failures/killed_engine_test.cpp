// POV-Ray and Blender themselves, killed at their work; and engines that do not want to end.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "failing_farm.hpp"
#include "farm/farm_engines.hpp"
#include "tests/json.hpp"

namespace lobelia {
namespace {

class KilledEngine : public FailingFarm {
 protected:
  void SetUp() override {
    for (const auto& here : find_engines({"povray", "blender"}, {}))
      if (!here.is_here()) GTEST_SKIP() << absence(here);
    grid({"8", "16", "32", "64"}, "<engine name=\"povray\"/><engine name=\"blender\"/>", 64);
    const FarmRun done = run_command({"farm", "grid.xml", "-o", "alone", "--cache", "alone-cache"});
    ASSERT_EQ(done.exit_code, 0) << done.output;
    ASSERT_EQ(done.rendered, 12u);
  }
  void expect_as_alone() const {
    EXPECT_THAT(differences(results_of(root() / "alone"), results_of(out())), testing::IsEmpty());
    expect_nothing_half_written();
  }
  /// Processes of an engine a tenth of a second after one was seen. One may end before: then of the next. They are
  /// stopped, so that none ends before it is killed.
  static std::vector<int> wait_for(const std::string& program, RunningFarm& farm) {
    std::vector<int> at_work;
    while (at_work.empty() && !farm.has_ended()) {
      while (farm.engines(program).empty() && !farm.has_ended())
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      for (const int pid : farm.engines(program)) ::kill(pid, SIGSTOP);
      at_work = farm.engines(program);
    }
    return at_work;
  }
};

TEST_F(KilledEngine, IsStartedAgainAndTheRecordSaysSo) {
  RunningFarm farm(command(), root());
  for (const char* program : {"povray", "blender"}) {
    const auto at_work = wait_for(program, farm);
    ASSERT_FALSE(at_work.empty()) << program << farm.output();
    for (const int pid : at_work) ::kill(pid, SIGKILL);
  }
  EXPECT_EQ(farm.wait(), 0) << farm.output();
  std::size_t again = 0;
  for (const char* cell : {"n8", "n16", "n32", "n64"})
    for (const char* job : {"reference-povray", "reference-blender"})
      if (read_json(result_of(cell, job) / "result.json").at("attempts") > 1) ++again;
  EXPECT_GE(again, 1u);
  expect_as_alone();
  EXPECT_EQ(run().rendered, 0u);
}

TEST_F(KilledEngine, ThatHasNoFurtherAttemptIsAFailureUntilTheNextRun) {
  {
    RunningFarm farm(command({"--attempts", "1"}), root());
    for (const int pid : wait_for("povray", farm)) ::kill(pid, SIGKILL);
    EXPECT_EQ(farm.wait(), 4) << farm.output();
    EXPECT_THAT(farm.output(), testing::HasSubstr("povray: POV-Ray was ended by signal 9"));
  }
  const std::size_t there = cached_pictures();
  const FarmRun second = run();
  EXPECT_EQ(second.exit_code, 0) << second.output;
  EXPECT_EQ(second.rendered, 12 - there);
  expect_as_alone();
}

TEST_F(KilledEngine, AndItsFarmTooLoseNoMoreThanTheyWereAt) {
  std::size_t engines_seen = 0, there = 0;
  // Each goes on from where the one before was killed, and has got a little further.
  for (const int milliseconds : {300, 700, 1100, 1500}) {
    SCOPED_TRACE(milliseconds);
    RunningFarm farm(command(), root());
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    const auto at_work = [&] {
      std::vector<int> found = farm.engines("povray");
      for (const int pid : farm.engines("blender")) found.push_back(pid);
      return found;
    };
    std::vector<int> engines = at_work();
    // On a machine with much else to do none may have begun yet: the last one waits for some.
    while (milliseconds == 1500 && engines_seen + engines.size() == 0 && !farm.has_ended()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      engines = at_work();
    }
    engines_seen += engines.size();
    farm.signal(SIGKILL);
    farm.wait();
    EXPECT_TRUE(end_soon(engines));
    EXPECT_GE(cached_pictures(), there);
    there = cached_pictures();
  }
  EXPECT_GT(engines_seen, 0u) << "or nothing is said about them";
  const FarmRun last = run();
  EXPECT_EQ(last.exit_code, 0) << last.output;
  EXPECT_EQ(last.rendered, 12 - there) << last.output;
  expect_as_alone();
}

/// An engine behind a wrapper that wants to live on, with children that have sessions of their own and ignore signals.
class ClingingEngine : public FailingFarm, public testing::WithParamInterface<const char*> {
 protected:
  ClingingEngine() { ::mkfifo(fifo().c_str(), 0600); }
  ~ClingingEngine() override { ::close(writer_); }
  fs::path fifo() const { return root() / "alive"; }
  /// `last` is what the engine itself does.
  std::string clinging(const std::string& last) const {
    return fmt::format(
        "exec 3<'{}'\n"  // whatever lives has it open
        "(setsid sh -c 'sleep 1000 & sleep 1000 &' &)\n"
        "(trap '' TERM HUP INT; sleep 1000; :) &\n"
        "{}\n",
        fifo().string(), last);
  }
  std::vector<std::string> environment() const {
    if (*GetParam() == '\0') return {};
    return {GetParam()};
  }
  /// Until somebody has it open to read from, and lets them go on.
  void meet(RunningFarm& farm) {
    while ((writer_ = ::open(fifo().c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC)) < 0 &&
           !farm.has_ended())
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_GE(writer_, 0) << farm.output();
  }
  /// Whether nothing has it open any more, now or within ten minutes.
  bool is_over(bool at_once) const {
    pollfd reader{writer_, 0, 0};
    return ::poll(&reader, 1, at_once ? 0 : 600'000) == 1;
  }

 private:
  int writer_ = -1;
};

TEST_P(ClingingEngine, LeavesNothingWhenItHasMadeItsPictures) {
  fake_povray(clinging(""));
  RunningFarm farm(command(), root(), environment());
  meet(farm);
  EXPECT_EQ(farm.wait(), 0) << farm.output();
  EXPECT_TRUE(is_over(true));
  const Json made = read_json(out() / "cells" / "n8" / "povray.json");
  EXPECT_NE(made.at("contained"), *GetParam() == '\0' ? "none" : "pid namespace");
}

TEST_P(ClingingEngine, LeavesNothingAfterItsTime) {
  fake_povray(clinging("sleep 1000"));
  RunningFarm farm(command({"--time-limit", "2", "--attempts", "1"}), root(), environment());
  meet(farm);
  EXPECT_EQ(farm.wait(), 4) << farm.output();
  EXPECT_TRUE(is_over(true));
}

TEST_P(ClingingEngine, LeavesNothingAfterCtrlC) {
  fake_povray(clinging("sleep 1000"));
  RunningFarm farm(command(), root(), environment());
  meet(farm);
  farm.signal(SIGINT);
  EXPECT_EQ(farm.wait(), 130) << farm.output();
  EXPECT_TRUE(is_over(true));
}

TEST_P(ClingingEngine, LeavesNothingWhenTheFarmIsKilled) {
  fake_povray(clinging("sleep 1000"));
  RunningFarm farm(command(), root(), environment());
  meet(farm);
  farm.signal(SIGKILL);
  farm.wait();
  EXPECT_TRUE(is_over(false));
}

INSTANTIATE_TEST_SUITE_P(Farm, ClingingEngine, testing::Values("", "LOBELIA_NO_NAMESPACE=1"));

}  // namespace
}  // namespace lobelia
