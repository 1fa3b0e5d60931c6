// Runs the program as a user does.
#pragma once

#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "lobelia_paths.hpp"
#include "tests/test.hpp"

namespace lobelia {

inline const std::string kScenes = std::string(LOBELIA_SOURCE_DIR) + "/reference_scenes/scenes/";

/// Exit code and everything printed, in `directory`.
inline ProcessResult run_lobelia(std::vector<std::string> arguments,
                                 const std::filesystem::path& directory) {
  arguments.insert(arguments.begin(), LOBELIA_PROGRAM);
  ProcessOptions options;
  options.working_directory = directory;
  return run_process(arguments, options);
}

/// The same through a shell, for redirections and limits; $LOBELIA is the program, $SCENES the directory of the scenes.
inline ProcessResult run_shell(const std::string& script, const std::filesystem::path& directory) {
  ProcessOptions options;
  options.working_directory = directory;
  return run_process(
      {"/bin/sh", "-c", "LOBELIA=$1 SCENES=$2\n" + script, "sh", LOBELIA_PROGRAM, kScenes},
      options);
}

/// An error as every command says it: in one line, which has these words.
inline void expect_one_line(const ProcessResult& result, int exit_code, const std::string& words) {
  const std::string& said = result.output_tail;
  EXPECT_EQ(result.exit_code, exit_code) << said;
  EXPECT_TRUE(said.starts_with("lobelia: ")) << said;
  EXPECT_THAT(said, testing::HasSubstr(words));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

/// grid.xml with a cell for each exponent.
inline void write_small_grid(const std::filesystem::path& directory,
                             const std::string& exponents = "16, 32", int side = 32) {
  const std::string pixels = std::to_string(side);
  write_file(directory / "grid.xml", "<grid version=\"1\"><scene file=\"" + kScenes +
                                         "head_on.xml\"/><film width=\"" + pixels + "\" height=\"" +
                                         pixels + "\"/><axis name=\"exponent\" values=\"" +
                                         exponents + "\"/><engine name=\"analytic\"/></grid>");
}

inline std::size_t files_in(const std::filesystem::path& directory) {
  return std::size_t(std::distance(std::filesystem::directory_iterator(directory),
                                   std::filesystem::directory_iterator()));
}

}  // namespace lobelia
