// Faults of disks and of the system in the middle of a command: one clear line, nothing lost, and no bug of ours.
#include <cerrno>

#include "run_lobelia.hpp"

namespace lobelia {
namespace {

class SystemFaults : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_grid(directory_.path());
    const auto made = run(
        "\"$LOBELIA\" render -q \"$SCENES\"head_on.xml --width 32 --height 32 -o a.exr --png a.png &&\n"
        "\"$LOBELIA\" farm grid.xml -q -o run");
    ASSERT_EQ(made.exit_code, 0) << made.output_tail;
    fs::create_directory(path("tmp"));
  }
  fs::path path(const std::string& name) const { return directory_.path() / name; }
  ProcessResult run(const std::string& script) const {
    return run_shell(script, directory_.path());
  }

  /// The command while a call fails. `at` is the end of its path.
  ProcessResult run_with(const std::string& call, int error, const std::string& at,
                         const std::string& arguments) const {
    const fs::path library = path("failing_calls.so");  // LD_PRELOAD takes paths apart at blanks
    if (!fs::exists(library)) fs::create_symlink(LOBELIA_FAILING_CALLS, library);
    // A file that it cannot remove stays in the test's directory.
    return run("TMPDIR=\"$PWD/tmp\" FAIL_CALL=" + call + " FAIL_ERRNO=" + std::to_string(error) +
               " FAIL_PATH='" + at + "' ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" +
               library.string() + " \"$LOBELIA\" " + arguments + " > /dev/null");
  }

  const TemporaryDirectory directory_;
};

TEST_F(SystemFaults, AreSaidInOneLineWithThePath) {
  struct Fault {
    const char* call;
    int error;
    const char *path, *arguments, *words;
  };
  for (const auto& [call, error, at, arguments, words] : {
           Fault{"stat", EIO, "lobelia_png.so", "compare a.exr a.exr --html report",
                 "lobelia_png.so: cannot read: Input/output error"},
           {"stat", ESTALE, "cost/cost.json", "gallery run -o site",
            "run/cost/cost.json: cannot read: Stale file handle"},
           {"stat", EIO, "a.exr", "compare a.exr a.exr --json record.json",
            "a.exr: cannot read: Input/output error"},
           {"getcwd", EIO, "", "farm grid.xml -q -o farm",
            "grid.xml: cannot tell where it is: Input/output error"},
           {"readdir", EIO, "", "gallery publish run -o site.html",
            "cannot be listed: Input/output error"},
           {"poll", EIO, "", "compare a.png a.png", "poll: Input/output error"},
           // The reader was waited for without end.
           {"sendmsg", EIO, "", "compare a.png a.png", "failed twice to read a.png (signal 9)"},
       }) {
    SCOPED_TRACE(std::string(call) + ": " + arguments);
    expect_one_line(run_with(call, error, at, arguments), 3, words);
    const auto again = run("\"$LOBELIA\" " + std::string(arguments) + " > /dev/null");
    EXPECT_EQ(again.exit_code, 0) << again.output_tail;
  }
}

TEST_F(SystemFaults, DoNotTurnAForeignFileIntoOneOfOurs) {
  fs::create_directory(path("site"));
  for (const char* foreign : {"site/index.html", "page.html"}) write_file(path(foreign), "mine");
  expect_one_line(run_with("stat", EIO, "index.html", "compare a.exr a.exr --html site"), 4,
                  "site/index.html: cannot read: Input/output error");
  expect_one_line(run_with("lstat", EIO, "page.html", "gallery publish run -o page.html"), 4,
                  "page.html: Input/output error");
  for (const char* foreign : {"site/index.html", "page.html"})
    EXPECT_EQ(read_file(path(foreign), 100), "mine") << foreign;
  EXPECT_EQ(files_in(path("site")), 1u);
}

TEST_F(SystemFaults, AMissingProcChangesNothing) {
  if (run("unshare -rm sh -c 'mount -t tmpfs none /mnt'").exit_code != 0)
    GTEST_SKIP() << "no mount namespaces here: unshare -rm is not allowed";
  const auto result =
      run("export LOBELIA SCENES; unshare -rm sh -c 'mount -t tmpfs none /proc &&\n"
          "\"$LOBELIA\" compare a.png a.png -q && \"$LOBELIA\" farm grid.xml -q -o run &&\n"
          "\"$LOBELIA\" farm doctor > /dev/null'");
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, testing::HasSubstr("0 pictures rendered, 4 kept"))
      << "results have the same keys";
}

}  // namespace
}  // namespace lobelia
