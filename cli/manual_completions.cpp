// Scripts that complete `lobelia`. Each finds the command in the words typed so far, then offers that command's words. An
// option's value is completed where it is one of a few words, a file or a directory.
#include <fmt/format.h>

#include <algorithm>

#include "cli/manual_tables.hpp"
#include "core/text.hpp"

namespace lobelia::cli {
namespace {

constexpr char kMadeBy[] = "# Made by `lobelia manual` from the options of the command line.\n";

/// ' render'|' farm'|'farm status': what turns the path of one command into that of another.
std::string case_of_paths(const std::vector<CommandRow>& all, const char* between) {
  std::string text;
  for (const CommandRow& command : all) {
    if (command.path.empty()) continue;
    const std::size_t blank = command.path.rfind(' ');
    const std::string step = blank == command.path.npos ? " " + command.path : command.path;
    text += (text.empty() ? "" : between) + shell_quote(step);
  }
  return text;
}

std::vector<std::string> names_of_options(const CommandRow& command) {
  std::vector<std::string> names;
  for (const OptionRow& option : command.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// "'render --effects') WHAT ;;" of every option with a value.
template <class What>
std::string cases_of_values(const std::vector<CommandRow>& all, What what) {
  std::string text;
  for (const CommandRow& command : all)
    for (const OptionRow& option : command.options) {
      if (option.names.empty() || option.kind == ValueKind::kNone) continue;
      std::string pattern;
      for (const std::string& name : option.names)
        pattern += (pattern.empty() ? "" : "|") + shell_quote(command.path + " " + name);
      text += fmt::format("    {}) {} ;;\n", pattern, what(option));
    }
  return text;
}

const CommandRow& subcommand(const std::vector<CommandRow>& all, const CommandRow& command,
                             const std::string& name) {
  const std::string path = command.path.empty() ? name : command.path + " " + name;
  return *std::ranges::find(all, path, &CommandRow::path);
}

/// One line for a menu.
std::string menu_text(const std::string& help) {
  std::string line = first_line(help);
  constexpr std::size_t kLongest = 70;
  if (line.size() <= kLongest) return line;
  return line.substr(0, line.rfind(' ', kLongest)) + " ...";
}

}  // namespace

std::string bash_completion(const std::vector<CommandRow>& all) {
  std::string commands;
  for (const CommandRow& command : all)
    commands += fmt::format("    {}) subcommands={} options={} ;;\n", shell_quote(command.path),
                            shell_quote(joined(command.subcommands)),
                            shell_quote(joined(names_of_options(command))));
  const std::string values = cases_of_values(all, [](const OptionRow& option) {
    if (option.kind == ValueKind::kWords) return "words=" + shell_quote(joined(option.words));
    return std::string(option.kind == ValueKind::kFile        ? "kind='file'"
                       : option.kind == ValueKind::kDirectory ? "kind='directory'"
                                                              : "kind='other'");
  });
  return kMadeBy + fmt::format(R"(_lobelia() {{
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
                               case_of_paths(all, "|"), values, commands);
}

std::string zsh_completion(const std::vector<CommandRow>& all) {
  const auto described = [](const std::string& name, const std::string& help) {
    std::string text;
    for (const char c : name) text += c == ':' ? std::string("\\:") : std::string(1, c);
    return " " + shell_quote(text + ":" + menu_text(help));
  };
  std::string commands;
  for (const CommandRow& command : all) {
    std::string subcommands, options;
    for (const std::string& name : command.subcommands)
      subcommands += described(name, subcommand(all, command, name).help);
    for (const OptionRow& option : command.options)
      for (const std::string& name : option.names) options += described(name, option.help);
    commands += fmt::format("    {}) subcommands=({} ) options=({} ) ;;\n",
                            shell_quote(command.path), subcommands, options);
  }
  const std::string values = cases_of_values(all, [](const OptionRow& option) {
    if (option.kind == ValueKind::kWords) {
      std::string words;
      for (const std::string& word : option.words) words += " " + shell_quote(word);
      return "compadd --" + words + "; return";
    }
    return std::string(option.kind == ValueKind::kFile        ? "_files; return"
                       : option.kind == ValueKind::kDirectory ? "_files -/; return"
                                                              : "_message value; return");
  });
  return std::string("#compdef lobelia\n") + kMadeBy +
         fmt::format(R"(local command_path='' word i
local -a subcommands options
for ((i = 2; i < CURRENT; ++i)); do
  word=${{words[i]}}
  case "$command_path $word" in
    ({}) command_path="${{command_path:+$command_path }}$word" ;;
  esac
done
case "$command_path ${{words[CURRENT - 1]}}" in
{}esac
case $command_path in
{}esac
if [[ $PREFIX == -* ]]; then
  _describe -o option options
  return
fi
((${{#subcommands}})) && _describe command subcommands
[[ -n $command_path ]] && _files
)",
                     case_of_paths(all, "|"), values, commands);
}

std::string fish_completion(const std::vector<CommandRow>& all) {
  std::string rules;
  const auto fish_word = [](const std::string& text) {
    std::string word = "'";
    for (const char c : text)
      word += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return word + "'";
  };
  for (const CommandRow& command : all) {
    const std::string rule =
        fmt::format("complete -c lobelia -n '__lobelia_at \"{}\"'", command.path);
    for (const std::string& name : command.subcommands)
      rules += fmt::format("{} -a {} -d {}\n", rule, name,
                           fish_word(menu_text(subcommand(all, command, name).help)));
    for (const OptionRow& option : command.options) {
      if (option.names.empty()) continue;
      std::string line = rule;
      for (const std::string& name : option.names)
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      switch (option.kind) {
        case ValueKind::kNone:
          break;
        case ValueKind::kWords:
          line += " -x -a " + fish_word(joined(option.words));
          break;
        case ValueKind::kDirectory:
          line += " -x -a '(__fish_complete_directories)'";
          break;
        case ValueKind::kFile:
          line += " -r -F";
          break;
        case ValueKind::kOther:
          line += " -x";
          break;
      }
      rules += line + " -d " + fish_word(menu_text(option.help)) + "\n";
    }
  }
  return kMadeBy + fmt::format(R"(function __lobelia_at
    set -l command_path ''
    for word in (commandline -opc)[2..-1]
        switch "$command_path $word"
            case {}
                set command_path (string trim -- "$command_path $word")
        end
    end
    test "$command_path" = "$argv[1]"
end
complete -c lobelia -n '__lobelia_at ""' -f
{})",
                               case_of_paths(all, " "), rules);
}

}  // namespace lobelia::cli
