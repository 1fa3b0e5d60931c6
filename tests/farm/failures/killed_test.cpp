// A farm that is killed at any moment.
#include <signal.h>
#include <unistd.h>

#include <thread>

#include "base/system/process.hpp"
#include "base/words/text.hpp"
#include "failing_farm.hpp"
#include "lobelia_paths.hpp"

namespace lobelia {
namespace {

class KilledFarm : public FailingFarm {
 protected:
  static ProcessOptions asked(const std::vector<std::string>& environment) {
    ProcessOptions options;
    options.environment = environment;
    return options;
  }
  void forget_everything() const {
    for (const auto& directory : {out(), cache()}) fs::remove_all(directory);
  }
  /// By a link, because the list of libraries is cut at blanks and the build's directory may have one.
  std::string dying_calls() const {
    const fs::path link = root() / "dying_calls.so";
    if (!fs::exists(link)) fs::create_symlink(LOBELIA_DYING_CALLS, link);
    return link.string();
  }
  std::vector<std::string> dying(const std::string& variable) const {
    return {"LD_PRELOAD=" + dying_calls(), "ASAN_OPTIONS=verify_asan_link_order=0", variable};
  }
};

TEST_F(KilledFarm, LosesOnlyUnfinishedResultsAtAnyWrite) {
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

TEST_F(KilledFarm, KeepsResultsThoughTheClockJumpsBack) {
  fs::path library;
  for (const auto& entry : fs::directory_iterator("/usr/lib"))
    if (const fs::path here = entry.path() / "faketime" / "libfaketimeMT.so.1"; fs::exists(here))
      library = here;
  if (library.empty()) GTEST_SKIP() << "no libfaketime (package faketime)";
  undisturbed();
  fake_povray("sleep 0.2");
  const fs::path clock = root() / "clock";
  for (const char* stat : {"NO_FAKE_STAT=1", "FAKETIME_FORCE_MONOTONIC_FIX=1"}) {
    SCOPED_TRACE(stat);
    forget_everything();
    const std::vector<std::string> environment{
        // The second one is there to keep the first from the engines, which may not write where it would.
        "LD_PRELOAD=" + library.string() + ":" + dying_calls(),
        "FAKETIME_TIMESTAMP_FILE=" + clock.string(), "FAKETIME_NO_CACHE=1",
        "FAKETIME_DONT_FAKE_MONOTONIC=1", stat};
    write_file(clock, "+400d");
    RunningFarm farm(command(), root(), environment);
    while (cached_pictures() < 2 && !farm.has_ended())
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    // Without the second library, which ends with the process that starts this one.
    std::vector<std::string> of_date = environment;
    of_date[0] = "LD_PRELOAD=" + library.string();
    const ProcessResult date = run_process({"/bin/date", "+%Y"}, asked(of_date));
    EXPECT_NE(date.output_tail, run_process({"/bin/date", "+%Y"}, asked({})).output_tail);
    write_file(clock, "-400d");
    EXPECT_EQ(farm.wait(), 0) << farm.output();
    expect_mended(run_command(command(), environment), 0);
    write_file(clock, "+1d");
    expect_mended(run_command(command(), environment), 0);
    const FarmRun gc = run_command({"farm", "gc", "cache"}, environment);
    EXPECT_THAT(gc.output, testing::HasSubstr("0 results removed")) << gc.output;
    expect_mended(run(), 0);
  }
}

// Farms that share a cache at the same time, and what else is at work in it.

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

// Disks of the test's own, in a mount namespace: full ones, and ones that may only be read.

class Disk : public FailingFarm {
 protected:
  void SetUp() override {
    ProcessOptions options;
    if (run_process({"/bin/sh", "-c", "unshare -rm sh -c 'mount -t tmpfs none /mnt'"}, options)
            .exit_code != 0)
      GTEST_SKIP() << "no mount namespaces here: unshare -rm is not allowed";
    undisturbed();
    fake_povray();
    fs::create_directories(cache());
  }
  /// Shell in a namespace of its own: $FARM is the farm's command, `$FARM >> a 2>&1; echo $?`.
  std::string in_namespace(const std::string& text) const {
    script("in_namespace", fmt::format("cd {}; export TMPDIR=$PWD/tmp\nlobelia() {{ {} \"$@\"; }}\n"
                                       "farm() {{ lobelia {} \"$@\"; }}\n{}",
                                       shell_quote(root().string()), shell_quote(LOBELIA_PROGRAM),
                                       shell_join(command()), text));
    ProcessOptions options;
    options.log = root() / "log";
    fs::remove(options.log);
    run_process({"/usr/bin/env", "unshare", "-rm", (root() / "in_namespace").string()}, options);
    return read_file(options.log, 1 << 26);
  }
};

TEST_F(Disk, EndsTheFarmInOneLineWhenFull) {
  // So small that nothing fits at all, then a bit more of it.
  for (const int kilobytes : {4, 16, 40, 60, 90, 120, 200}) {
    SCOPED_TRACE(kilobytes);
    fs::remove_all(out());
    const std::string said = in_namespace(
        fmt::format("mount -t tmpfs -o size={}k none cache\n"
                    "farm -q > first 2>&1; echo first $?; wc -l < first; cat first\n"
                    "find cache/making cache/failures -type f; find cache out -name '*.part'\n"
                    "mount -o remount,size=100M cache\n"
                    "echo second; farm -q; echo second $?; find cache/making -mindepth 1\n",
                    kilobytes));
    EXPECT_THAT(said, testing::StartsWith("first 4\n1\nlobelia: "));
    EXPECT_THAT(said,
                HasSubstr("No space left on device\nsecond\n4 cells: 0 failed, 0 differ, 4 pass;"));
    EXPECT_THAT(said, testing::EndsWith("second 0\n"));
    EXPECT_THAT(differences(undisturbed(), results_of(out())), testing::IsEmpty());
  }
}

TEST_F(Disk, MayBeFullWhereTheFarmsDirectoryIs) {
  fs::create_directories(out());
  for (const int kilobytes : {4, 40, 100}) {
    SCOPED_TRACE(kilobytes);
    const std::string said = in_namespace(fmt::format(
        "mount -t tmpfs -o size={}k none out\n"
        "farm -q > first 2>&1; echo first $?; wc -l < first; cat first; find out -name '*.part'\n"
        "mount -o remount,size=100M out\n"
        "echo second; farm -q; echo second $?; cp -a out/. there\n",
        kilobytes));
    EXPECT_THAT(said, testing::StartsWith("first 4\n1\nlobelia: "));
    EXPECT_THAT(said,
                HasSubstr("No space left on device\nsecond\n4 cells: 0 failed, 0 differ, 4 pass;"));
    EXPECT_THAT(differences(undisturbed(), results_of(root() / "there")), testing::IsEmpty());
  }
}

TEST_F(Disk, ServesItsResultsIfReadOnly) {
  ASSERT_EQ(run().exit_code, 0);
  fs::remove_all(out());
  const std::string said = in_namespace(
      "mount --bind cache cache && mount -o remount,bind,ro cache\n"
      "touch cache/x 2> touched; wc -l < touched\n"
      "farm; echo $?; farm status out; echo $?; lobelia farm verify out -q; echo $?\n");
  EXPECT_THAT(said, testing::StartsWith(
                        "1\n4 cells: 0 failed, 0 differ, 4 pass; 0 pictures rendered, 8 kept\n"));
  EXPECT_THAT(differences(undisturbed(), results_of(out())), testing::IsEmpty());
  EXPECT_THAT(said, HasSubstr("all whole\n0\n"));
}

TEST_F(Disk, ExplainsAMissingFileOnAReadOnlyDisk) {
  ASSERT_EQ(run().exit_code, 0);
  fs::remove_all(result_of("n16", "reference-povray"));
  const std::string said = in_namespace(
      "mount --bind cache cache && mount -o remount,bind,ro cache\n"
      "farm -q; echo $?\n");
  EXPECT_THAT(said, testing::MatchesRegex("lobelia: [^\n]*Read-only file system\n4\n"));
  expect_mended(run(), 1);
}

}  // namespace
}  // namespace lobelia
