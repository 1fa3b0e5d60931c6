// The commands and options as CLI11 has them, for man pages, completions and docs/: there is no second list.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
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

/// Pages for man(1) and a script that completes `lobelia` in bash.
std::string man_page(const CommandRow& command, const std::vector<CommandRow>& all);
std::string bash_completion(const std::vector<CommandRow>& all);

/// A row of a table that people look up, such as an exit code.
struct Fact {
  std::string name, meaning;  ///< several names are separated by ", "
};
struct FactTable {
  std::string title, heading, remark;
  std::vector<Fact> facts;
};
/// Exit codes, environment variables and files.
std::span<const FactTable> fact_tables();

/// Files by their path.
using Files = std::map<std::string, std::string>;

/// Pages of docs/.
std::string command_line_page(const std::vector<CommandRow>& commands);
std::string environment_page();
/// models.md and its charts.
Files models_documentation();

/// Text for a page of docs/, with links to other pages.
std::string markdown(std::string_view text);
/// "(n + 1) / (2 pi)" as LaTeX. Empty if it is no formula.
std::string latex(std::string_view formula);

/// "lobelia-farm-status"
std::string man_name(const CommandRow& command);
/// The text up to the first line break.
std::string first_line(const std::string& text);

}  // namespace lobelia::cli
