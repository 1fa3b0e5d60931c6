#include "run_lobelia.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(FarmCommand, ReportsHowEnginesAreContained) {
  const TemporaryDirectory directory;
  // The caller may have given us a namespace without a /proc of its own.
  const auto here =
      run_shell("read process rest < /proc/self/stat; [ $process = $$ ]", directory.path());
  const auto usual = run_shell("\"$LOBELIA\" farm doctor", directory.path());
  EXPECT_THAT(usual.output_tail,
              HasSubstr(here.exit_code == 0 ? "held to --memory" : "--memory has no effect"));
  EXPECT_THAT(usual.output_tail, HasSubstr("engines' writing"));
  const auto without =
      run_shell("LOBELIA_NO_NAMESPACE=1 \"$LOBELIA\" farm doctor", directory.path());
  EXPECT_THAT(without.output_tail, HasSubstr("no PID namespace: a subreaper ends them"));
}

TEST(FarmCommand, LeavesNoEngineBehindAfterCtrlC) {
  const TemporaryDirectory directory;
  // An engine that would take a minute; known in the list of processes by its odd time.
  write_file(directory.path() / "slow-povray",
             "#!/bin/sh\ncase \"$*\" in *version*) echo 'POV-Ray 3.7.0.10' >&2; exit 0;; esac\n"
             "exec sleep 61.7\n");
  write_file(directory.path() / "grid.xml",
             "<grid version=\"1\"><scene file=\"" + kScenes +
                 "head_on.xml\"/><film width=\"32\" height=\"32\"/><axis name=\"model\" "
                 "values=\"modified_phong\"/><engine name=\"povray\"/></grid>");
  const auto result = run_shell(
      "chmod +x slow-povray\n"
      "\"$LOBELIA\" farm grid.xml -o out -q --povray ./slow-povray & job=$!\n"
      "until grep -qsa 'sleep.61[.]7' /proc/[0-9]*/cmdline && ls out/cache/results/*/*/lobelia.exr; do\n"
      "  sleep 0.1; kill -0 $job || break\n"
      "done > /dev/null 2>&1\n"
      "kill -INT $job; wait $job; code=$?\n"
      "find out -name '*.part' -o -name '.*'\n"
      "grep -la 'sleep.61[.]7' /proc/[0-9]*/cmdline 2>/dev/null | grep -v self\n"
      "exit $code",
      directory.path());
  EXPECT_EQ(result.exit_code, 130) << result.output_tail;
  EXPECT_EQ(
      result.output_tail,
      "lobelia: interrupted; what is done is kept, and the same command goes on from there\n");
  const auto out = directory.path() / "out";
  EXPECT_EQ(read_json(out / "farm.json")["cells"][0]["status"], "missing");
  EXPECT_TRUE(std::filesystem::exists(out / "cells/modified_phong/lobelia.exr"));
}

TEST(FarmCommand, RepairsFilesReportedByItsGallery) {
  const TemporaryDirectory directory;
  write_small_grid(directory.path());
  const std::vector<std::string> farm{"farm", "grid.xml", "-o", "out", "-q", "--gallery", "site"},
      gallery{"gallery", "out", "-o", "site"};
  ASSERT_EQ(run_lobelia(farm, directory.path()).exit_code, 0);
  const auto cells = directory.path() / "out/cells";
  const auto expect_found = [&](const std::string& state, const std::string& words) {
    const auto found = run_lobelia(gallery, directory.path());
    EXPECT_EQ(found.exit_code, 1) << state;
    EXPECT_THAT(found.output_tail, HasSubstr("lobelia: gallery: n16: " + state + ": " + words));
    EXPECT_THAT(found.output_tail,
                HasSubstr("lobelia: gallery: 1 of 2 cells is not what the farm wrote\n"));
    EXPECT_THAT(found.output_tail, HasSubstr("site/index.html\n"));
    const auto mended = run_lobelia(farm, directory.path());
    EXPECT_EQ(mended.exit_code, 0) << mended.output_tail;
    EXPECT_EQ(run_lobelia(gallery, directory.path()).exit_code, 0) << state;
  };
  std::filesystem::remove(cells / "n16/lobelia-analytic.json");
  expect_found("missing", "lobelia-analytic.json is missing.");
  std::filesystem::remove(cells / "n16/analytic.exr");
  std::filesystem::copy_file(cells / "n32/analytic.exr", cells / "n16/analytic.exr");
  expect_found("changed", "analytic.exr is not the file that the farm wrote");
  std::filesystem::remove(cells / "n16/lobelia.exr");
  write_file(cells / "n16/lobelia.exr",
             read_file(cells / "n32/lobelia.exr", 1 << 20).substr(0, 700));
  expect_found("damaged", "lobelia.exr cannot be read");
  Json record = read_json(cells / "n16/cell.json");
  record["axes"]["exponent"] = "17";
  write_json(cells / "n16/cell.json", record);
  expect_found("changed", "cell.json is not the record that the farm wrote");
}

TEST(FarmCommand, FailsUpFrontIfItsGalleryCannotBeWritten) {
  const TemporaryDirectory directory;
  write_small_grid(directory.path());
  write_file(directory.path() / "site", std::string_view("a file"));
  const auto result =
      run_lobelia({"farm", "grid.xml", "-o", "out", "-q", "--gallery", "site"}, directory.path());
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_THAT(result.output_tail, HasSubstr("site: cannot make the directory"));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "out"));
}

}  // namespace
}  // namespace lobelia
