// Runs the program as a user does.
#pragma once

#include <string>
#include <vector>

#include "core/files.hpp"
#include "core/process.hpp"
#include "lobelia_paths.hpp"

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

inline std::size_t files_in(const std::filesystem::path& directory) {
  return std::size_t(std::distance(std::filesystem::directory_iterator(directory),
                                   std::filesystem::directory_iterator()));
}

}  // namespace lobelia
