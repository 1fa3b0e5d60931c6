// The pages of docs/ about the command line and what surrounds the program.
#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "base/words/text.hpp"
#include "program/command/manual/manual_tables.hpp"

namespace lobelia::cli {
namespace {

/// In a table, where a bar would end the cell.
std::string code(std::string_view text) {
  return fmt::format("`{}`", std::regex_replace(std::string(text), std::regex(R"(\|)"), R"(\|)"));
}

/// "0.1 to 60" of "FLOAT:0.1 to 60", which CLI11 makes of a number's range.
std::string range_of(const OptionRow& option) {
  const std::size_t colon = option.value.find(':');
  return colon == option.value.npos || !option.words.empty() ? "" : option.value.substr(colon + 1);
}

std::string option_cell(const OptionRow& option) {
  if (!option.positional.empty()) return code(option.positional + (option.repeated ? "..." : ""));
  std::string value;
  if (!option.words.empty())
    value = " WORD";
  else if (!option.value.empty())
    value = " " + option.value.substr(0, option.value.find(':'));
  std::string names;
  for (const std::string& name : option.names)
    names +=
        (names.empty() ? "" : ", ") + code(name + (&name == &option.names.back() ? value : ""));
  return names;
}

std::string meaning_cell(const OptionRow& option) {
  std::string text = markdown(option.help);
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto add = [&](std::string_view what, const std::string& values) {
    if (!values.empty()) text += fmt::format(". {}: {}", what, values);
  };
  std::string words;
  for (const std::string& word : option.words) words += (words.empty() ? "" : ", ") + code(word);
  add("Allowed", words.empty() ? range_of(option) : words);
  add("Default", option.default_value.empty() ? "" : code(option.default_value));
  return text + (option.required ? ". Required" : "");
}

std::string usage(const CommandRow& command) {
  std::string text = "lobelia" + (command.path.empty() ? "" : " " + command.path);
  if (!command.subcommands.empty()) text += command.needs_subcommand ? " COMMAND" : " [COMMAND]";
  for (const OptionRow& option : command.options)
    if (option.required && !option.names.empty())
      text += fmt::format(" {} {}", option.names.front(), option.value);
  text += " [OPTIONS]";
  for (const OptionRow& option : command.options)
    if (!option.positional.empty())
      text += fmt::format(" {}{}{}{}", option.required ? "" : "[", option.positional,
                          option.repeated ? "..." : "", option.required ? "" : "]");
  return text;
}

std::string section(const CommandRow& command) {
  std::string text = fmt::format(
      "\n## lobelia{}{}\n\n{}{}\n\n```\n{}\n```\n", command.path.empty() ? "" : " ", command.path,
      markdown(command.help), command.help.ends_with('.') ? "" : ".", usage(command));
  std::vector<std::string> headings;
  std::vector<OptionRow> options = command.options;
  // Every command has it.
  std::erase_if(options, [](const OptionRow& option) {
    return std::ranges::count(option.names, "--help") > 0;
  });
  for (const OptionRow& option : options)
    if (std::ranges::count(headings, option.heading) == 0) headings.push_back(option.heading);
  for (const std::string& heading : headings) {
    text += fmt::format("\n| {} | meaning |\n|---|---|\n", heading);
    for (const OptionRow& option : options)
      if (option.heading == heading)
        text += fmt::format("| {} | {} |\n", option_cell(option), meaning_cell(option));
  }
  if (!command.footer.empty()) text += fmt::format("\n```\n{}\n```\n", command.footer);
  return text;
}

constexpr std::string_view kMade =
    "<!-- Made by `lobelia manual --docs docs`; a test keeps the two the same. -->\n";

}  // namespace

std::string markdown(std::string_view text) {
  static const std::regex option("(^|[ (])(--[a-z][a-z-]*)"), page("docs/([a-z_/]+[.]md)");
  std::string result;
  for (const char c : text) {
    if (std::string_view("\\`*<[|$").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return std::regex_replace(std::regex_replace(result, option, "$1`$2`"), page, "[$&]($1)");
}

std::string command_line_page(const std::vector<CommandRow>& commands) {
  std::string page = fmt::format(
      "# The command line\n\n{}\nFor anyone who looks up an option. `lobelia COMMAND --help` and "
      "`man lobelia-COMMAND` say the same.\n[Exit codes, environment and files](environment.md) "
      "have a page of their own.\n\n| command | |\n|---|---|\n",
      kMade);
  for (const CommandRow& command : commands)
    if (!command.path.empty())
      page += fmt::format("| [`{}`](#{}) | {} |\n", command.path, man_name(command),
                          markdown(first_line(command.help)));
  for (const CommandRow& command : commands) page += section(command);
  return page;
}

std::string environment_page() {
  std::string page = fmt::format(
      "# Exit codes, environment and files\n\n{}\nFor anyone who calls Lobelia from a script. "
      "[CHANGELOG.md](../CHANGELOG.md#what-is-promised) says what stays the same.\n",
      kMade);
  for (const FactTable& table : fact_tables()) {
    page += fmt::format("\n## {}\n\n{}{}| {} | meaning |\n|---|---|\n", table.title, table.remark,
                        table.remark.empty() ? "" : "\n\n", table.heading);
    for (const Fact& fact : table.facts) {
      std::string names;
      for (const std::string& name : split(fact.name, ","))
        names += (names.empty() ? "" : ", ") + code(name);
      page += fmt::format("| {} | {} |\n", names, markdown(fact.meaning));
    }
  }
  return page;
}

}  // namespace lobelia::cli
