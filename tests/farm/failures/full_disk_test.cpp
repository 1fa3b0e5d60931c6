// Disks of the test's own, in a mount namespace: full ones, and ones that may only be read.
#include "base/system/process.hpp"
#include "base/words/text.hpp"
#include "failing_farm.hpp"
#include "lobelia_paths.hpp"

namespace lobelia {
namespace {

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
