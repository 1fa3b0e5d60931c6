// Farms that share a cache at the same time, and what else is at work in it.
#include <signal.h>
#include <unistd.h>

#include <thread>

#include "base/system/process.hpp"
#include "base/words/text.hpp"
#include "failing_farm.hpp"
#include "lobelia_paths.hpp"

namespace lobelia {
namespace {

class RacingFarms : public FailingFarm {
 protected:
  RacingFarms() {
    undisturbed();
    fake_povray("sleep 0.1");
  }
  std::vector<std::string> command_in(const std::string& directory) const {
    auto arguments = command();
    arguments[3] = directory;
    return arguments;
  }
  std::size_t rendered_by(const RunningFarm& farm) const {
    const std::string text = farm.output();
    const auto end = text.find(" pictures rendered");
    return end == text.npos ? 0 : std::stoul(text.substr(text.rfind(' ', end - 1)));
  }
  void wait_for_pictures(std::size_t count, RunningFarm& farm) const {
    while (cached_pictures() < count && !farm.has_ended()) ::usleep(5000);
  }
};

TEST_F(RacingFarms, MakeEachResultOnce) {
  for (const char* other : {"out", "other", "third"}) {
    SCOPED_TRACE(other);
    fs::remove_all(cache());
    fs::remove_all(out());
    RunningFarm a(command(), root()), b(command_in(other), root());
    EXPECT_EQ(a.wait(), 0) << a.output();
    EXPECT_EQ(b.wait(), 0) << b.output();
    EXPECT_EQ(rendered_by(a) + rendered_by(b), pictures()) << a.output() << b.output();
    EXPECT_THAT(differences(undisturbed(), results_of(root() / other)), testing::IsEmpty());
    expect_mended(run(), 0);
  }
}

TEST_F(RacingFarms, AreNotDisturbedByStatusOrGc) {
  fake_povray(waits());
  RunningFarm farm(command(), root());
  wait_for_pictures(1, farm);
  const FarmRun gc = run_command({"farm", "gc", "cache", "--max-size", "0"});
  EXPECT_EQ(gc.exit_code, 4) << gc.output;
  EXPECT_THAT(gc.output, HasSubstr("a farm is using this cache"));
  const FarmRun status = run_command({"farm", "status", "out"});
  EXPECT_EQ(status.exit_code, 0) << status.output;
  EXPECT_THAT(status.output, testing::StartsWith("4 cells: "));
  EXPECT_THAT(status.output, HasSubstr("; a farm is at work"));
  let_go_on();
  EXPECT_EQ(farm.wait(), 0) << farm.output();
  EXPECT_THAT(run_command({"farm", "status", "out"}).output, testing::StrEq("4 cells: 4 pass\n"));
  expect_mended(run(), 0);
}

TEST_F(RacingFarms, BeginThoughSomebodyAsksForTheStatusAllTheTime) {
  ASSERT_EQ(run().exit_code, 0);
  std::string looks;
  const fs::path stop = root() / "stop";
  script("look", fmt::format("while [ ! -e {} ]; do {} farm status {} > /dev/null; done",
                             shell_quote(stop.string()), shell_quote(LOBELIA_PROGRAM),
                             shell_quote(out().string())));
  ProcessOptions options;
  std::jthread looking([&] { run_process({(root() / "look").string()}, options); });
  for (int i = 0; i < 10; ++i) EXPECT_EQ(run({"-q"}).exit_code, 0);
  write_file(stop, "");
}

TEST_F(RacingFarms, TakeTurnsWithGc) {
  ASSERT_EQ(run().exit_code, 0);
  fake_povray();
  for (int i = 0; i < 6; ++i) {
    RunningFarm gc({"farm", "gc", "cache", "--max-size", "0"}, root());
    const FarmRun farm = run();
    const int code = gc.wait();
    EXPECT_THAT(code, testing::AnyOf(0, 4)) << gc.output();
    EXPECT_THAT(farm.exit_code, testing::AnyOf(0, 4)) << farm.output;
    if (farm.exit_code == 4) {
      EXPECT_THAT(farm.output, HasSubstr("'lobelia farm gc' is at work"));
    }
  }
  expect_mended(run());
}

}  // namespace
}  // namespace lobelia
