// Workflow commands of GitHub Actions, which shows them beside the change.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "base/words/text.hpp"

namespace lobelia {

struct GithubCommand {
  std::string_view level;  ///< "error", "warning" or "notice"
  std::string file;        ///< "" for none
  std::size_t line = 0;    ///< from 1; 0 for none
  std::string title, message;
};

/// "::error file=...,line=...,title=...::..." and a line end. What would end it or a part of it is %XX there, so that no
/// name of a file can forge a command.
inline std::string github_line(const GithubCommand& command) {
  const auto escaped = [](std::string_view text, std::string_view ends) {
    std::string safe;
    for (const char c : printable_path(text))
      safe += ends.find(c) == ends.npos ? std::string(1, c) : fmt::format("%{:02X}", int(c));
    return safe;
  };
  constexpr std::string_view kOfMessage = "%\r\n", kOfProperty = "%\r\n:,";
  std::string place;
  if (!command.file.empty()) place = "file=" + escaped(command.file, kOfProperty) + ",";
  if (command.line > 0) place += fmt::format("line={},", command.line);
  return fmt::format("::{} {}title={}::{}\n", command.level, place,
                     escaped(command.title, kOfProperty), escaped(command.message, kOfMessage));
}

}  // namespace lobelia
