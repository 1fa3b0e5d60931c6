// The commands of a page: its blocks that begin with ```sh are to be run, in their order and in one directory.
#pragma once

#include "tests/program/run_lobelia.hpp"

namespace lobelia {

/// Commands of the whole page, or from the line `from` on.
inline std::string page_commands(const std::string& page, const std::string& from = "") {
  const std::string text =
      read_file(std::filesystem::path(LOBELIA_SOURCE_DIR) / page, std::size_t{1} << 20);
  std::string commands;
  for (std::size_t at = text.find(from); (at = text.find("```sh\n", at)) != text.npos;) {
    at += 6;
    const std::size_t end = text.find("```", at);
    commands += text.substr(at, end - at);
    at = end;
  }
  return commands;
}

/// Runs them beside links to the docs and the scenes. `before` may define functions of the shell.
inline ProcessResult run_commands(
    const std::string& commands, const std::filesystem::path& directory,
    const std::string& before = "lobelia() { \"$LOBELIA\" \"$@\" < /dev/null; }\n") {
  for (const char* folder : {"docs", "reference_scenes"})
    std::filesystem::create_directory_symlink(std::filesystem::path(LOBELIA_SOURCE_DIR) / folder,
                                              directory / folder);
  return run_shell("set -e\n" + before + commands, directory);
}

}  // namespace lobelia
