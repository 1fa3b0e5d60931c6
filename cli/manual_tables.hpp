// The commands and options as CLI11 has them, for man pages and completions: there is no second list.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace lobelia::cli {

enum class ValueKind : std::uint8_t { kNone, kWords, kFile, kDirectory, kOther };

struct OptionRow {
  std::vector<std::string> names;  ///< "-o", "--output"; empty for a positional argument
  std::string positional;          ///< "SCENE"
  std::string heading;
  std::string value;  ///< "FILE", "{truth,none}"; empty for a flag
  std::string help, default_value;
  bool required = false, repeated = false;
  ValueKind kind = ValueKind::kNone;
  std::vector<std::string> words;  ///< for kWords
};

struct CommandRow {
  std::string path;  ///< "farm status"; empty for the program itself
  std::string help, footer;
  bool needs_subcommand = false;
  std::vector<OptionRow> options;
  std::vector<std::string> subcommands;  ///< without those that help does not show
};

/// The program and all commands, each before its own subcommands.
std::vector<CommandRow> command_rows(const CLI::App& program);

/// Pages for man(1) and scripts that complete `lobelia` in a shell.
std::string man_page(const CommandRow& command, const std::vector<CommandRow>& all);
std::string bash_completion(const std::vector<CommandRow>& all);
std::string zsh_completion(const std::vector<CommandRow>& all);
std::string fish_completion(const std::vector<CommandRow>& all);

/// "lobelia-farm-status"
std::string man_name(const CommandRow& command);
/// The text up to the first line break.
std::string first_line(const std::string& text);

}  // namespace lobelia::cli
