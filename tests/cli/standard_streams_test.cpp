// Stdin, stdout and stderr that are closed, full, broken or not read, under every command.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "lobelia_paths.hpp"
#include "run_lobelia.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// A command that says something on stderr, and its exit code.
struct Command {
  const char* arguments;
  int exit_code;
};

constexpr Command kTalkative[] = {
    {"render \"$SCENES\"two_lights.xml -o out.exr", 0},
    {"render \"$SCENES\"two_lights.xml -o out.png", 2},
    {"render missing.xml -o out.exr", 3},
    {"render \"$SCENES\"two_lights.xml -o no/such/out.exr", 4},
    {"rendr", 2},
    {"compare a.exr b.exr --diff-image out.png", 1},
    {"compare a.exr a.exr --diff-image out.png", 0},
    {"compare a.exr missing.exr", 3},
    {"profile missing.exr --scene \"$SCENES\"head_on.xml", 3},
    {"engines --povray /no/such", 5},
    {"reference \"$SCENES\"head_on.xml --engine analytic --width 16 --height 16 -o out.exr", 0},
    {"reference \"$SCENES\"head_on.xml --engine povray --povray /no/such -o out.exr", 5},
    {"farm grid.xml -o out --gallery site", 0},
    {"farm grid.xml -o out --dry-run --filter 'n17*'", 0},
    {"farm missing.xml -o out", 3},
    {"gallery changed", 1},
    {"gallery missing", 3},
    {"gallery serve site", 2},
    {"verify paper --json no/such/out.json", 4},
    {"plan missing.xml", 3},
    {"export --language glsl no_model", 2},
    {"models --exponent nan", 2},
};

/// An end of a pipe as stderr that nobody reads any more; the shell's descriptor 4.
constexpr char kBrokenPipe[] = "mkfifo pipe; : < pipe & exec 4> pipe; wait\n";

class StandardStreams : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_grid(directory_.path(), "16");
    const auto made = run_shell(
        "\"$LOBELIA\" render -q \"$SCENES\"head_on.xml -o a.exr &&\n"
        "\"$LOBELIA\" render -q \"$SCENES\"oblique_45.xml -o b.exr &&\n"
        "\"$LOBELIA\" farm grid.xml -q -o changed &&\n"
        "for f in changed/cells/*/lobelia.exr; do rm \"$f\"; cp a.exr \"$f\"; done",
        directory_.path());
    ASSERT_EQ(made.exit_code, 0) << made.output_tail;
  }
  fs::path path(const std::string& name) const { return directory_.path() / name; }

  TemporaryDirectory directory_;
};

TEST_F(StandardStreams, StderrThatCannotBeWrittenChangesNoExitCode) {
  for (const auto& [arguments, exit_code] : kTalkative) {
    for (const char* where : {"2> errors.txt", "2> /dev/full", "2>&- <&-", "2>&4"}) {
      const auto result = run_shell(
          kBrokenPipe + std::string("\"$LOBELIA\" ") + arguments + " > /dev/null " + where +
              "; code=$?; rm -rf pipe out out.exr out.exr.json out.json out.png site; exit $code",
          directory_.path());
      ASSERT_EQ(result.exit_code, exit_code) << arguments << " " << where << result.output_tail;
    }
    // Else the rest has shown nothing.
    EXPECT_GT(fs::file_size(path("errors.txt")), 0u) << arguments;
  }
}

TEST_F(StandardStreams, FailWithExitCode4OnAFullDisk) {
  std::size_t number = 0;
  for (const char* command : {"--help",
                              "--version",
                              "render --help",
                              "farm --help",
                              "verify paper --help",
                              "models",
                              "models --json -",
                              "scene-format",
                              "compare --list-metrics",
                              "engines",
                              "engines --json -",
                              "compare a.exr b.exr",
                              "compare a.exr b.exr --json -",
                              "compare a.exr b.exr --csv -",
                              "compare a.exr b.exr --junit -",
                              "profile a.exr --scene \"$SCENES\"head_on.xml",
                              "profile a.exr --scene \"$SCENES\"head_on.xml --json -",
                              "plan \"$SCENES\"head_on.xml",
                              "plan \"$SCENES\"head_on.xml --json -",
                              "export --language glsl modified_phong",
                              "farm grid.xml -q -o changed",
                              "farm grid.xml -o new --dry-run",
                              "farm status changed",
                              "farm verify changed",
                              "gallery changed"}) {
    if (is_left_out(number++, 4)) continue;
    for (const char* where : {"> /dev/full", ">&-", ">&4"}) {
      const auto result = run_shell(kBrokenPipe + std::string("\"$LOBELIA\" ") + command + " " +
                                        where + " 2> errors.txt; code=$?; rm pipe; exit $code",
                                    directory_.path());
      const std::string errors = read_file(path("errors.txt"), 1 << 16);
      const std::string shown = std::string(command) + " " + where + "\n" + errors;
      const bool has_no_reader = std::string_view(where) == ">&4";
      EXPECT_EQ(result.exit_code, has_no_reader ? 141 : 4) << shown;
      EXPECT_EQ(errors.ends_with("lobelia: standard output: cannot write\n"), !has_no_reader)
          << shown;
    }
  }
}

TEST_F(StandardStreams, ReceiveNoPictureWhenTheyAreClosed) {
  const std::string render =
      "\"$LOBELIA\" render \"$SCENES\"two_lights.xml --png out.png -o out.exr --samples 2";
  ASSERT_EQ(run_shell(render + " -q && mkdir whole && mv out.* whole", directory_.path()).exit_code,
            0);
  for (const char* closed : {"2>&-", "<&- 2>&-", "<&- >&- 2>&-"}) {
    const auto result = run_shell(
        render + " " + closed + " && cmp out.exr whole/out.exr && cmp out.png whole/out.png",
        directory_.path());
    EXPECT_EQ(result.exit_code, 0) << closed << result.output_tail;
  }
}

class FullPipe {
 public:
  FullPipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC | O_NONBLOCK) != 0) ADD_FAILURE() << "pipe2";
    const std::array<char, 4096> filling{};
    while (::write(ends_[1], filling.data(), filling.size()) > 0) filled_ += filling.size();
    ::fcntl(ends_[0], F_SETFL, 0);
    ::fcntl(ends_[1], F_SETFL, 0);  // as a program gets it
  }
  ~FullPipe() {
    ::close(ends_[0]);
    if (ends_[1] >= 0) ::close(ends_[1]);
  }
  FullPipe(const FullPipe&) = delete;
  FullPipe& operator=(const FullPipe&) = delete;

  /// Starts the program with it as stderr, and keeps the reading end alone.
  pid_t start(const std::vector<std::string>& arguments) {
    std::vector<std::string> words{LOBELIA_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const pid_t pid = ::fork();
    if (pid == 0) {
      ::dup2(ends_[1], 2);
      ::execv(argv[0], argv.data());
      ::_exit(99);
    }
    ::close(ends_[1]);
    ends_[1] = -1;
    return pid;
  }
  /// The program's output, once it has ended.
  std::string rest() const {
    std::string all;
    std::array<char, 4096> piece{};
    for (ssize_t n = 0; (n = ::read(ends_[0], piece.data(), piece.size())) > 0;)
      all.append(piece.data(), std::size_t(n));
    return all.substr(filled_);
  }

 private:
  std::array<int, 2> ends_{-1, -1};
  std::size_t filled_ = 0;
};

int exit_code_of(pid_t pid) {
  int status = 0;
  ::waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST_F(StandardStreams, AMessageWaitsForItsReaderAndIsWhole) {
  FullPipe pipe;
  const std::string name(2000, 'x');
  const pid_t pid = pipe.start({"models", "--" + name, name});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const std::string text = pipe.rest();
  EXPECT_EQ(exit_code_of(pid), 2);
  EXPECT_TRUE(text.starts_with("lobelia: ")) << text;
  EXPECT_TRUE(text.ends_with("\n")) << text;
}

TEST_F(StandardStreams, EndOnSigtermDespiteAnUnreadMessage) {
  FullPipe pipe;
  const pid_t pid = pipe.start({"plan", "missing.xml"});
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(::waitpid(pid, nullptr, WNOHANG), 0) << "it has somebody to wait for";
  ::kill(pid, SIGTERM);
  const int code = exit_code_of(pid);  // waits for ever if it hangs
  EXPECT_TRUE(code == 3 || code == 143) << code;
}

TEST_F(StandardStreams, ProgressWaitsForNobody) {
  FullPipe pipe;
  // Interrupted while it works, and the line about that finds no room either.
  const pid_t pid = pipe.start({"render", kScenes + "oblique_45.xml", "--width", "2048", "--height",
                                "2048", "--samples", "65536", "-o", path("long.exr").string()});
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  ::kill(pid, SIGTERM);
  EXPECT_EQ(exit_code_of(pid), 143);
}

}  // namespace
}  // namespace lobelia
