// Ctrl-C, SIGTERM and SIGHUP, as the program gets them: real signals at many moments of its work.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "base/pictures/image_io.hpp"
#include "lobelia_paths.hpp"
#include "run_lobelia.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Only what hangs takes so long after a signal.
constexpr Seconds kHang{600};

struct Ended {
  int code = -1;           ///< or 128 + the signal that ended it; -1 for one that hung
  bool was_ready = false;  ///< it had time to say how it handles signals
  std::string errors;
};

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

  /// Runs the program, and sends it the signal after `delay`; 0 sends none.
  Ended run(const std::vector<std::string>& arguments, int signal, Seconds delay) {
    fs::remove_all(path("out"));
    fs::create_directories(path("out"));
    std::vector<std::string> words{LOBELIA_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    write_file(path("errors.txt"), "");  // for one that ends before it can
    const pid_t pid = ::fork();
    if (pid == 0) {
      ::setenv("TMPDIR", path("tmp").c_str(), 1);
      if (::chdir(folder_.path().c_str()) != 0) ::_exit(99);
      ::dup2(::open("errors.txt", O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
      ::dup2(::open("/dev/null", O_WRONLY), 1);
      ::execv(argv[0], argv.data());
      ::_exit(99);
    }
    std::this_thread::sleep_for(delay);
    const auto sent = Clock::now();
    if (signal != 0) ::kill(pid, signal);
    Ended ended;
    int status = 0;
    while (::waitpid(pid, &status, WNOHANG) == 0) {
      if (Clock::now() - sent > kHang) {
        ::kill(pid, SIGKILL);
        ::waitpid(pid, &status, 0);
        return ended;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ended.was_ready = WIFEXITED(status);
    ended.errors = read_file(path("errors.txt"), 1 << 20);
    return ended;
  }

  /// Files below out/ by name, and their bytes.
  std::map<std::string, std::string> outputs() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(path("out")))
      if (entry.is_regular_file())
        files[entry.path().lexically_relative(path("out")).string()] =
            read_file(entry.path(), 1 << 26);
    return files;
  }

  void expect_nothing_left(const std::string& what) const {
    for (const auto& [name, bytes] : outputs()) ADD_FAILURE() << what << " left " << name;
    expect_no_temporaries(what);
  }
  void expect_no_temporaries(const std::string& what) const {
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << what << entry.path();
    EXPECT_TRUE(fs::is_empty(path("tmp"))) << what;
  }

  /// Work that takes long beyond the delays: it always ends by the signal.
  void expect_ended_by_signals(const std::vector<std::string>& arguments) {
    std::mt19937 random(4);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGTERM, SIGINT}) {
      const Seconds delay(0.02 + 0.8 * double(random() % 1000) / 1000);
      const std::string what = fmt_words(arguments) + " with signal " + std::to_string(signal) +
                               " after " + std::to_string(delay.count()) + " s";
      const Ended ended = run(arguments, signal, delay);
      EXPECT_EQ(ended.code, 128 + signal) << what;
      if (ended.was_ready) {
        EXPECT_TRUE(ended.errors.ends_with("lobelia: interrupted\n")) << what << ended.errors;
      }
      expect_nothing_left(what);
    }
  }

  /// Work that is short: it is ended by the signal and leaves nothing, or is done and leaves all.
  void expect_all_or_nothing(const std::vector<std::string>& arguments, int rounds) {
    const auto started = Clock::now();
    const Ended whole = run(arguments, 0, Seconds(0));
    const Seconds takes = Clock::now() - started;
    const auto all = outputs();
    ASSERT_FALSE(all.empty()) << fmt_words(arguments) << whole.errors;
    std::mt19937 random(18);
    int ended_early = 0;
    for (int i = 0; i < rounds; ++i) {
      const int signal = i % 2 == 0 ? SIGINT : SIGTERM;
      const Seconds delay(takes * 1.1 * double(random() % 10000) / 10000);
      const std::string what = fmt_words(arguments) + " after " + std::to_string(delay.count());
      const Ended ended = run(arguments, signal, delay);
      if (ended.code == 128 + signal) {
        expect_nothing_left(what);
        ++ended_early;
      } else {
        EXPECT_EQ(ended.code, whole.code) << what << ended.errors;
        EXPECT_EQ(names(outputs()), names(all)) << what;
        expect_no_temporaries(what);
      }
    }
    EXPECT_GT(ended_early, 0) << "no signal came in time";
  }

  static std::vector<std::string> names(const std::map<std::string, std::string>& files) {
    std::vector<std::string> result;
    for (const auto& [name, bytes] : files) result.push_back(name);
    return result;
  }
  static std::string fmt_words(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += word + " ";
    return text;
  }

  TemporaryDirectory folder_;
};

TEST_F(Interrupted, ComparisonOfTwoFilesEndsAndLeavesNothing) {
  noisy_picture("a.exr", 1920, 1080, 1), noisy_picture("b.exr", 1920, 1080, 2);
  expect_ended_by_signals({"compare", "a.exr", "b.exr", "--exposures", "-10,10,100", "--json",
                           "out/r.json", "--diff-image", "out/d.png"});
}

TEST_F(Interrupted, ComparisonOfFoldersEndsAndLeavesNothing) {
  for (int i = 0; i < 12; ++i)
    for (const char* folder : {"a/", "b/"})
      noisy_picture(folder + std::to_string(i) + ".exr", 600, 600, unsigned(i));
  expect_ended_by_signals({"compare", "a", "b", "--exposures", "-10,10,100", "--json", "out/r.json",
                           "--csv", "out/r.csv", "--diff-image", "out/maps"});
}

TEST_F(Interrupted, ComparisonOfFoldersLeavesAllOfItsFilesOrNone) {
  for (int i = 0; i < 6; ++i)
    for (const char* folder : {"a/", "b/"})
      noisy_picture(folder + std::to_string(i) + ".exr", 64, 64, unsigned(i));
  expect_all_or_nothing({"compare", "a", "b", "--json", "out/r.json", "--csv", "out/r.csv",
                         "--junit", "out/r.xml", "--diff-image", "out/maps"},
                        40);
}

TEST_F(Interrupted, RenderLeavesAllOfItsFilesOrNone) {
  expect_all_or_nothing({"render", kScenes + "two_lights.xml", "-q", "-o", "out/x.exr", "--png",
                         "out/x.png", "--samples", "4", "--standard-error", "out/error.exr"},
                        40);
}

TEST_F(Interrupted, ProfileLeavesAllOfItsFilesOrNone) {
  noisy_picture("a.exr", 600, 600, 1), noisy_picture("b.exr", 600, 600, 2);
  expect_all_or_nothing({"profile", "a.exr", "b.exr", "--csv", "out/p.csv", "--svg", "out/p.svg",
                         "--json", "out/p.json"},
                        30);
}

TEST_F(Interrupted, OtherLongWorkEndsAndLeavesNothing) {
  const std::vector<std::string> commands[] = {
      {"render", kScenes + "oblique_45.xml", "--width", "4096", "--height", "4096", "--samples",
       "4096", "-q", "-o", "out/x.exr"},
      {"cost", kScenes + "oblique_45.xml", "--level", "lobe", "--level", "picture", "--thorough",
       "-q", "-o", "out"},
      {"verify", "stability", "-q", "--json", "out/s.json", "--pictures", "out"},
      {"verify", "paper", "--json", "out/p.json", "--plots", "out"},
  };
  for (const auto& arguments : commands) expect_ended_by_signals(arguments);
}

TEST_F(Interrupted, PublishingLeavesNoHalfFile) {
  write_small_grid(folder_.path(), "16, 32, 64, 128", 128);
  ASSERT_EQ(run({"farm", "grid.xml", "-o", "run", "-q"}, 0, Seconds(0)).code, 0);
  const std::vector<std::string> publish{"gallery", "run", "-o", "out"};
  const auto started = Clock::now();
  ASSERT_EQ(run(publish, 0, Seconds(0)).code, 0);
  const Seconds takes = Clock::now() - started;
  const auto all = outputs();
  std::mt19937 random(13);
  int ended_early = 0;
  for (int i = 0; i < 20; ++i) {
    const int signal = i % 2 == 0 ? SIGINT : SIGTERM;
    const Ended ended = run(publish, signal, takes * double(random() % 10000) / 10000);
    expect_no_temporaries("publishing");
    for (const auto& [name, bytes] : outputs()) {
      ASSERT_TRUE(all.contains(name)) << name;
      // The list comes first, and is whole when all is there.
      if (ended.code != 0 && name == "gallery.json") continue;
      EXPECT_EQ(bytes, all.at(name)) << name;
    }
    if (ended.code == 0) continue;
    EXPECT_EQ(ended.code, 128 + signal);
    ++ended_early;
  }
  EXPECT_GT(ended_early, 0);
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
  EXPECT_EQ(result.output_tail, "lobelia: interrupted\n");
}

}  // namespace
}  // namespace lobelia
