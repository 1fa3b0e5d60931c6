// A farm that is killed at any moment.
#include <signal.h>

#include <thread>

#include "base/system/process.hpp"
#include "failing_farm.hpp"

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

}  // namespace
}  // namespace lobelia
