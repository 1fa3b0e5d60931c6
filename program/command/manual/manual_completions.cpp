// A script that completes `lobelia`. It finds the command in the words typed so far, then offers that command's words. An
// option's value is completed where it is one of a few words, a file or a directory.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/words/text.hpp"
#include "program/command/manual/manual_tables.hpp"

namespace lobelia::cli {
namespace {

/// ' render'|' farm'|'farm status': what turns the path of one command into that of another.
std::string case_of_paths(const std::vector<CommandRow>& all) {
  std::string text;
  for (const CommandRow& command : all) {
    if (command.path.empty()) continue;
    const std::size_t blank = command.path.rfind(' ');
    const std::string step = blank == command.path.npos ? " " + command.path : command.path;
    text += (text.empty() ? "" : "|") + shell_quote(step);
  }
  return text;
}

std::string quoted(const std::vector<std::string>& words) {
  return shell_quote(fmt::format("{}", fmt::join(words, " ")));
}

std::string case_of_command(const CommandRow& command) {
  std::vector<std::string> options;
  for (const OptionRow& option : command.options)
    options.insert(options.end(), option.names.begin(), option.names.end());
  return fmt::format("    {}) subcommands={} options={} ;;\n", shell_quote(command.path),
                     quoted(command.subcommands), quoted(options));
}

/// "'render --effects') words='as-called-for all' ;;"
std::string case_of_value(const CommandRow& command, const OptionRow& option) {
  if (option.names.empty() || option.kind == ValueKind::kNone) return "";
  std::string pattern;
  for (const std::string& name : option.names)
    pattern += (pattern.empty() ? "" : "|") + shell_quote(command.path + " " + name);
  return fmt::format("    {}) {} ;;\n", pattern,
                     option.kind == ValueKind::kWords       ? "words=" + quoted(option.words)
                     : option.kind == ValueKind::kFile      ? "kind='file'"
                     : option.kind == ValueKind::kDirectory ? "kind='directory'"
                                                            : "kind='other'");
}

}  // namespace

std::string bash_completion(const std::vector<CommandRow>& all) {
  std::string commands, values;
  for (const CommandRow& command : all) {
    commands += case_of_command(command);
    for (const OptionRow& option : command.options) values += case_of_value(command, option);
  }
  return fmt::format(R"(# Made by `lobelia manual` from the options of the command line.
_lobelia() {{
  local path='' word i subcommands='' options='' words='' kind=''
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${{COMP_WORDS[i]}}
    case "$path $word" in
    {}) path="${{path:+$path }}$word" ;;
    esac
  done
  # Bash takes --name=value for three words.
  if [[ $current == = ]]; then
    current=''
  elif [[ $previous == = ]] && ((COMP_CWORD > 1)); then
    previous=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  case "$path $previous" in
{}  esac
  case $kind in
    file) compopt -o default; return ;;
    directory) compopt -o dirnames; return ;;
    other) return ;;
  esac
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    return
  fi
  case $path in
{}  esac
  if [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
    return
  fi
  mapfile -t COMPREPLY < <(compgen -W "$subcommands" -- "$current")
  if [[ -n $path ]]; then compopt -o default; fi
}}
complete -F _lobelia lobelia
)",
                     case_of_paths(all), values, commands);
}

}  // namespace lobelia::cli
