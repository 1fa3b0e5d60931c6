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

TEST_F(KilledEngine, RecordsItsRestart) {
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
  EXPECT_THAT(differences(results_of(root() / "alone"), results_of(out())), testing::IsEmpty());
  expect_nothing_half_written();
  EXPECT_EQ(run().rendered, 0u);
}

using ClingingEngine = FailingFarm;

/// Behind a wrapper that wants to live on, with children that have sessions of their own and ignore signals.
TEST_F(ClingingEngine, LeavesNothingWhenTheFarmIsKilled) {
  const fs::path alive = root() / "alive";
  fake_povray(
      fmt::format("exec 3<'{}'\n"  // whatever lives has it open
                  "(setsid sh -c 'sleep 1000 & sleep 1000 &' &)\n"
                  "(trap '' TERM HUP INT; sleep 1000; :) &\n"
                  "sleep 1000\n",
                  alive.string()));
  for (const std::vector<std::string>& environment :
       {std::vector<std::string>{}, {"LOBELIA_NO_NAMESPACE=1"}}) {
    SCOPED_TRACE(testing::PrintToString(environment));
    ASSERT_EQ(::mkfifo(alive.c_str(), 0600), 0);
    RunningFarm farm(command(), root(), environment);
    int writer = -1;
    // Until somebody has it open to read from, and lets them go on.
    while ((writer = ::open(alive.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC)) < 0 &&
           !farm.has_ended())
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_GE(writer, 0) << farm.output();
    farm.signal(SIGKILL);
    farm.wait();
    pollfd reader{writer, 0, 0};
    EXPECT_EQ(::poll(&reader, 1, 600'000), 1) << "something lives on";
    ::close(writer);
    fs::remove(alive);
  }
}

}  // namespace
}  // namespace lobelia
