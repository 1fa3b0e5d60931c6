// Ctrl-C, SIGTERM and SIGHUP, as the program gets them: real signals at many moments of its work.
#include <fmt/format.h>

#include <csignal>

#include "base/pictures/image_io.hpp"
#include "run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// A program says this when it caught a signal. One that got it too early says nothing.
constexpr char kInterrupted[] = "lobelia: interrupted\n";

class Interrupted : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"a", "b", "out", "tmp"}) fs::create_directories(path(folder));
  }
  fs::path path(const std::string& name) const { return folder_.path() / name; }

  void noisy_picture(const std::string& name, int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    Image image(width, height);
    for (float& value : image.values()) value = float(random() % 4096) / 512;
    write_exr(path(name), image, {});
  }

  /// Runs the program, and sends it the signal after so many seconds; 0 sends none.
  ProcessResult run(const std::string& arguments, int signal = 0, double delay = 0) {
    fs::remove_all(path("out"));
    fs::create_directories(path("out"));
    const std::string sender =
        signal == 0
            ? ""
            : fmt::format("{{ sleep {}; kill -{} $$; }} > /dev/null 2>&1 &\n", delay, signal);
    return run_shell(
        "export TMPDIR=\"$PWD/tmp\"\n" + sender + "exec \"$LOBELIA\" " + arguments + " > /dev/null",
        folder_.path());
  }

  /// The files below out/.
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(path("out")))
      if (entry.is_regular_file()) result.push_back(entry.path().lexically_relative(path("out")));
    std::ranges::sort(result);
    return result;
  }

  void expect_nothing_left(const std::string& what) const {
    EXPECT_THAT(names(), IsEmpty()) << what;
    expect_no_temporaries(what);
  }
  void expect_no_temporaries(const std::string& what) const {
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << what << entry.path();
    EXPECT_TRUE(fs::is_empty(path("tmp"))) << what;
  }

  /// Work that takes long beyond the delays: it always ends by the signal.
  void expect_ended_by_signals(const std::string& arguments) {
    std::mt19937 random(4);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGTERM, SIGINT}) {
      const double delay = 0.02 + 0.8 * double(random() % 1000) / 1000;
      const std::string what = fmt::format("{}, signal {} after {} s", arguments, signal, delay);
      const ProcessResult ended = run(arguments, signal, delay);
      EXPECT_EQ(ended.exit_code, 128 + signal) << what;
      EXPECT_THAT(ended.output_tail, testing::AnyOf("", testing::EndsWith(kInterrupted))) << what;
      expect_nothing_left(what);
    }
  }

  /// Work that is short: it is ended by the signal and leaves nothing, or is done and leaves all.
  void expect_all_or_nothing(const std::string& arguments) {
    const ProcessResult whole = run(arguments);
    const auto all = names();
    ASSERT_FALSE(all.empty()) << arguments << whole.output_tail;
    std::mt19937 random(18);
    int ended_early = 0;
    for (int i = 0; i < 40; ++i) {
      const int signal = i % 2 == 0 ? SIGINT : SIGTERM;
      const double delay = whole.seconds * 1.1 * double(random() % 10000) / 10000;
      const std::string what = fmt::format("{} after {} s", arguments, delay);
      const ProcessResult ended = run(arguments, signal, delay);
      if (ended.exit_code == 128 + signal) {
        expect_nothing_left(what);
        ++ended_early;
      } else {
        EXPECT_EQ(ended.exit_code, whole.exit_code) << what << ended.output_tail;
        EXPECT_EQ(names(), all) << what;
        expect_no_temporaries(what);
      }
    }
    EXPECT_GT(ended_early, 0) << "no signal came in time";
  }

  TemporaryDirectory folder_;
};

TEST_F(Interrupted, LongWorkEndsAndLeavesNothing) {
  noisy_picture("a.exr", 1920, 1080, 1), noisy_picture("b.exr", 1920, 1080, 2);
  for (int i = 0; i < 12; ++i)
    for (const char* folder : {"a/", "b/"})
      noisy_picture(folder + std::to_string(i) + ".exr", 600, 600, unsigned(i));
  const char* const commands[] = {
      "compare a.exr b.exr --exposures -10,10,100 --json out/r.json --diff-image out/d.png",
      "compare a b --exposures -10,10,100 --json out/r.json --csv out/r.csv --diff-image out/maps",
      "render \"$SCENES\"oblique_45.xml --width 4096 --height 4096 --samples 4096 -q -o out/x.exr",
      "cost \"$SCENES\"oblique_45.xml --level lobe --level picture --thorough -q -o out",
      "verify stability -q --json out/s.json --pictures out",
      "verify paper --json out/p.json --plots out",
  };
  for (const char* arguments : commands) expect_ended_by_signals(arguments);
}

TEST_F(Interrupted, ShortWorkLeavesAllOfItsFilesOrNone) {
  noisy_picture("a.exr", 600, 600, 1), noisy_picture("b.exr", 600, 600, 2);
  for (int i = 0; i < 6; ++i)
    for (const char* folder : {"a/", "b/"})
      noisy_picture(folder + std::to_string(i) + ".exr", 64, 64, unsigned(i));
  const char* const commands[] = {
      "compare a b --json out/r.json --csv out/r.csv --junit out/r.xml --diff-image out/maps",
      "render \"$SCENES\"two_lights.xml -q -o out/x.exr --png out/x.png --samples 4 "
      "--standard-error out/error.exr",
      "profile a.exr b.exr --csv out/p.csv --svg out/p.svg --json out/p.json",
  };
  for (const char* arguments : commands) expect_all_or_nothing(arguments);
}

TEST_F(Interrupted, AProcessWhoseOutputNobodyReadsEndsAsWell) {
  // Their record is longer than what a pipe holds.
  for (int i = 0; i < 60; ++i)
    for (const char* folder : {"a/", "b/"})
      noisy_picture(folder + std::to_string(i) + ".exr", 16, 16, 3);
  const ProcessResult result = run_shell(
      "mkfifo pipe; { dd bs=1 count=1 of=first 2>/dev/null; exec sleep 1000; } <pipe & reader=$!\n"
      "\"$LOBELIA\" compare a b --json - >pipe & job=$!\n"
      "until [ -s first ]; do sleep 0.1; kill -0 $job || break; done\n"
      "sleep 1; kill -TERM $job; wait $job; code=$?; kill $reader; exit $code",
      folder_.path());
  EXPECT_EQ(result.exit_code, 143) << result.output_tail;
  EXPECT_EQ(result.output_tail, kInterrupted);
}

}  // namespace
}  // namespace lobelia
