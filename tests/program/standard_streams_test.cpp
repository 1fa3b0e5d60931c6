// Stdin, stdout and stderr that are closed, full, broken or not read, under every command.
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

/// A full pipe, of which the shell has both ends as its descriptor 3.
constexpr char kFullPipe[] =
    "mkfifo pipe; exec 3<> pipe\n"
    "dd if=/dev/zero of=pipe bs=4096 oflag=nonblock 2> /dev/null\n";

TEST_F(StandardStreams, AMessageWaitsForItsReaderAndIsWhole) {
  const std::string name(2000, 'x');
  const ProcessResult result =
      run_shell(kFullPipe + std::string("\"$LOBELIA\" models --") + name + " " + name +
                    " 2>&3 3>&- & job=$!; sleep 0.3; exec 4< pipe 3>&-; tr -d '\\0' <&4; wait $job",
                directory_.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(result.output_tail.starts_with("lobelia: ")) << result.output_tail;
  EXPECT_TRUE(result.output_tail.ends_with("\n")) << result.output_tail;
}

TEST_F(StandardStreams, EndOnSigtermDespiteAnUnreadMessage) {
  const ProcessResult result =
      run_shell(kFullPipe + std::string("\"$LOBELIA\" plan missing.xml 2>&3 & job=$!; sleep 0.3\n"
                                        "jobs > state; grep -q Running state || exit 99\n"
                                        "kill -TERM $job; wait $job"),
                directory_.path());
  EXPECT_THAT(result.exit_code, testing::AnyOf(3, 143));
}

TEST_F(StandardStreams, ProgressWaitsForNobody) {
  // Interrupted while it works, and the line about that finds no room either.
  const ProcessResult result = run_shell(
      kFullPipe + std::string("\"$LOBELIA\" render \"$SCENES\"oblique_45.xml --width 2048 --height "
                              "2048 --samples 65536 -o long.exr 2>&3 & job=$!; sleep 0.5\n"
                              "kill -TERM $job; wait $job"),
      directory_.path());
  EXPECT_EQ(result.exit_code, 143);
}

}  // namespace
}  // namespace lobelia
