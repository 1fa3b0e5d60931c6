// `lobelia compare` that is killed while it writes a report: the same command writes it whole.
#include <csignal>

#include "run_lobelia.hpp"

namespace lobelia {
namespace {

class KilledReport : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto made =
        run_shell("\"$LOBELIA\" render -q \"$SCENES\"head_on.xml --width 32 --height 32 -o a.exr",
                  directory_.path());
    ASSERT_EQ(made.exit_code, 0) << made.output_tail;
    fs::create_symlink(LOBELIA_DYING_CALLS, path("dying_calls.so"));
  }
  fs::path path(const std::string& name) const { return directory_.path() / name; }

  /// Writes the report, with these variables of dying_calls.cpp.
  ProcessResult report(const std::string& dying = "") const {
    const std::string preload = dying.empty()
                                    ? ""
                                    : dying + " ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" +
                                          path("dying_calls.so").string() + " ";
    return run_shell(preload + "\"$LOBELIA\" compare a.exr a.exr -q --html report",
                     directory_.path());
  }
  /// The report's files by name. Removes them.
  std::map<std::string, std::string> taken() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(path("report")))
      if (entry.is_regular_file())
        files[entry.path().lexically_relative(path("report")).string()] =
            read_file(entry.path(), 1 << 26);
    fs::remove_all(path("report"));
    return files;
  }

  const TemporaryDirectory directory_;
};

TEST_F(KilledReport, IsWrittenWholeByTheSameCommandWheneverItWasKilled) {
  const auto counted = report("COUNT_CALLS=calls");
  ASSERT_EQ(counted.exit_code, 0) << counted.output_tail;
  const auto whole = taken();
  EXPECT_TRUE(whole.contains("index.html"));
  const int calls = std::stoi(read_file(path("calls"), 100));
  ASSERT_GT(calls, 10);
  // The last of all gives the list of files its name.
  for (const int at : {1, 2, 3, calls / 2, calls - 1, calls}) {
    SCOPED_TRACE("killed at call " + std::to_string(at) + " of " + std::to_string(calls));
    EXPECT_EQ(report("DIE_AT=" + std::to_string(at)).exit_code, 128 + SIGKILL);
    const auto again = report();
    EXPECT_EQ(again.exit_code, 0) << again.output_tail;
    EXPECT_EQ(taken(), whole) << "the same bytes, and nothing unfinished";
  }
}

TEST_F(KilledReport, IsRefusedBeforeItsFirstFileWhereItsListCannotBe) {
  fs::create_directories(path("report/gallery.json"));
  EXPECT_EQ(report().exit_code, 4);
  EXPECT_FALSE(fs::exists(path("report/index.html"))) << "it could not be told from another's";
  fs::remove(path("report/gallery.json"));
  const auto again = report();
  EXPECT_EQ(again.exit_code, 0) << again.output_tail;
}

}  // namespace
}  // namespace lobelia
