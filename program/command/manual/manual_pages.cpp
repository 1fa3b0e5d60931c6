#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/system/version.hpp"
#include "base/words/text.hpp"
#include "program/command/manual/manual_tables.hpp"

namespace lobelia::cli {
namespace {

/// Text as it is, for roff: signs that it would set as others, and lines that it would take for a request.
std::string roff(std::string_view text) {
  std::string result;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) result += "\\&";
    at_start = c == '\n';
    switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '`':
        result += "\\(ga";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// May be broken after a comma or a bar, as lists of choices are longer than a line.
std::string breakable(const std::string& value) {
  std::string result;
  for (const char c : roff(value)) {
    result += c;
    if (c == ',' || c == '|') result += "\\:";
  }
  return result;
}

std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string upper_case(std::string text) {
  for (char& c : text) c = char(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string synopsis(const CommandRow& command) {
  std::string text = fmt::format(".B {}", roff("lobelia"));
  if (!command.path.empty()) text += " " + roff(command.path);
  std::string rest = "\n";
  if (!command.subcommands.empty())
    rest += command.needs_subcommand ? "COMMAND ...\n" : "[COMMAND] ...\n";
  for (const OptionRow& option : command.options)
    if (option.required && !option.names.empty())
      rest += fmt::format("{} {}\n", roff(option.names.front()), breakable(option.value));
  rest += "[OPTIONS]\n";
  for (const OptionRow& option : command.options)
    if (!option.positional.empty())
      rest += fmt::format("{}{}{}{}\n", option.required ? "" : "[", roff(option.positional),
                          option.repeated ? "..." : "", option.required ? "" : "]");
  return text + rest;
}

std::string item(const OptionRow& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += (names.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
  if (!option.positional.empty())
    names = "\\fI" + roff(option.positional) + "\\fR";
  else if (!option.value.empty())
    names += " \\fI" + breakable(option.value) + "\\fR";
  std::string text = fmt::format(".TP\n{}\n{}\n", names, roff(option.help));
  if (!option.default_value.empty())
    text += fmt::format(".br\nDefault: {}.\n", roff(option.default_value));
  if (option.required) text += ".br\nRequired.\n";
  return text;
}

}  // namespace

std::string man_page(const CommandRow& command, const std::vector<CommandRow>& all) {
  const std::string name = man_name(command);
  // No date: the same source gives the same page.
  std::string page = fmt::format(
      ".\\\" Made by `lobelia manual` from the options of the command line.\n"
      ".TH {} 1 \"\" \"{}\" \"User Commands\"\n.ad l\n.nh\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{}",
      roff(upper_case(name)), kNameAndVersion, roff(name), roff(in_one_line(command.help)),
      synopsis(command));
  std::string heading;
  bool has_arguments = false;
  for (const OptionRow& option : command.options) {
    if (option.positional.empty()) continue;
    if (!has_arguments) page += ".SH ARGUMENTS\n";
    has_arguments = true;
    page += item(option);
  }
  std::vector<std::string> headings;
  for (const OptionRow& option : command.options)
    if (!option.names.empty() && std::ranges::count(headings, option.heading) == 0)
      headings.push_back(option.heading);
  for (const std::string& one : headings) {
    page += fmt::format(".SH \"{}\"\n", roff(upper_case(one)));
    for (const OptionRow& option : command.options)
      if (!option.names.empty() && option.heading == one) page += item(option);
  }
  const std::string prefix = command.path.empty() ? "" : command.path + " ";
  if (!command.subcommands.empty()) page += ".SH COMMANDS\n";
  for (const CommandRow& other : all)
    for (const std::string& sub : command.subcommands)
      if (other.path == prefix + sub)
        page += fmt::format(".TP\n\\fB{}\\fR(1)\n{}\n", roff(man_name(other)),
                            roff(in_one_line(other.help)));
  if (!command.footer.empty())
    page += fmt::format(".SH NOTES\n.nf\n{}\n.fi\n", roff(command.footer));
  if (!command.path.empty()) return page + ".SH \"SEE ALSO\"\n.BR lobelia (1)\n";
  for (const FactTable& table : fact_tables()) {
    page += fmt::format(".SH \"{}\"\n{}\n", upper_case(table.title), roff(table.remark));
    for (const Fact& fact : table.facts)
      page += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(fact.name), roff(fact.meaning));
  }
  return page;
}

}  // namespace lobelia::cli
