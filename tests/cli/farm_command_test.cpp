#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/record.hpp"
#include "run_lobelia.hpp"

namespace lobelia {
namespace {

using testing::HasSubstr;

void write_small_grid(const std::filesystem::path& directory) {
  write_file(directory / "grid.xml",
             "<grid version=\"1\"><scene file=\"" + kScenes +
                 "head_on.xml\"/><film width=\"32\" height=\"32\"/><axis name=\"exponent\" "
                 "values=\"16, 32\"/><engine name=\"analytic\"/></grid>");
}

TEST(FarmCommand, StoppedByCtrlCLeavesNoEngineBehindAndKeepsWhatIsDone) {
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
      "timeout --preserve-status -s INT 4 \"$LOBELIA\" farm grid.xml -o out -q "
      "--povray ./slow-povray\n"
      "code=$?\n"
      "find out -name '*.part' -o -name '.*'\n"
      "grep -l 'sleep.61[.]7' /proc/[0-9]*/cmdline 2>/dev/null | grep -v self\n"
      "exit $code",
      directory.path());
  EXPECT_EQ(result.exit_code, 130) << result.output_tail;
  EXPECT_EQ(
      result.output_tail,
      "lobelia: interrupted; what is done is kept, and the same command goes on from there\n");
  const auto out = directory.path() / "out";
  EXPECT_EQ(read_record(out / "farm.json", "farm")["cells"][0]["status"], "missing");
  EXPECT_TRUE(std::filesystem::exists(out / "cells/modified_phong/lobelia.exr"));
}

TEST(FarmCommand, PublishesTheGalleryThatItIsAskedFor) {
  const TemporaryDirectory directory;
  write_small_grid(directory.path());
  const auto result =
      run_lobelia({"farm", "grid.xml", "-o", "out", "-q", "--gallery", "site"}, directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr("gallery: site/index.html"));
  EXPECT_TRUE(std::filesystem::exists(directory.path() / "site/cells/n16/index.html"));
  EXPECT_TRUE(
      std::filesystem::exists(directory.path() / "site/cells/n16/analytic.map.flip.ldr.js"));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "out/index.html"));
}

TEST(FarmCommand, SaysAtOnceThatItsGalleryCannotBeWritten) {
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
