#include "program/command/manual/manual_tables.hpp"

#include "base/words/text.hpp"

namespace lobelia::cli {
namespace {

/// The words of "TEXT:{truth,none}", as CLI::IsMember names them.
std::vector<std::string> words_of(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.rfind('}');
  if (open == type.npos || close == type.npos || close < open) return {};
  return split(std::string_view(type).substr(open + 1, close - open - 1), ",");
}

ValueKind kind_of(const OptionRow& row) {
  if (row.value.empty()) return ValueKind::kNone;
  if (!row.words.empty()) return ValueKind::kWords;
  if (row.value.starts_with("DIR")) return ValueKind::kDirectory;
  // "ERROR.exr", but not "FLOAT:0.001 to 1".
  const bool is_file =
      row.value.starts_with("FILE") || row.value.starts_with("PATH") ||
      (row.value.find('.') != row.value.npos && row.value.find(':') == row.value.npos);
  return is_file ? ValueKind::kFile : ValueKind::kOther;
}

OptionRow option_row(const CLI::Option& option) {
  OptionRow row;
  for (const std::string& name : option.get_snames()) row.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) row.names.push_back("--" + name);
  if (row.names.empty()) row.positional = option.get_name(true);
  row.heading = option.get_group();
  row.help = option.get_description();
  row.default_value = option.get_default_str();
  row.required = option.get_required();
  row.repeated = option.get_items_expected_max() > 1;
  if (option.get_items_expected_max() == 0) return row;
  row.value = option.get_type_name();
  row.words = words_of(row.value);
  // CLI11 puts its own name of the type before the choices.
  if (!row.words.empty()) row.value = row.value.substr(row.value.find('{'));
  row.kind = row.positional.empty() ? kind_of(row) : ValueKind::kFile;
  return row;
}

void add_rows(const CLI::App& command, const std::string& path, std::vector<CommandRow>& rows) {
  CommandRow row;
  row.path = path;
  row.help = command.get_description();
  row.footer = command.get_footer();
  row.needs_subcommand = command.get_require_subcommand_min() > 0;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty()) row.options.push_back(option_row(*option));
  std::vector<const CLI::App*> shown;
  for (const CLI::App* sub : command.get_subcommands(nullptr))
    if (!sub->get_group().empty()) shown.push_back(sub);
  for (const CLI::App* sub : shown) row.subcommands.push_back(sub->get_name());
  rows.push_back(std::move(row));
  for (const CLI::App* sub : shown)
    add_rows(*sub, path.empty() ? sub->get_name() : path + " " + sub->get_name(), rows);
}

}  // namespace

std::vector<CommandRow> command_rows(const CLI::App& program) {
  std::vector<CommandRow> rows;
  add_rows(program, "", rows);
  return rows;
}

std::string man_name(const CommandRow& command) {
  std::string name = "lobelia";
  for (const std::string& word : split(command.path, " ")) name += "-" + word;
  return name;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace lobelia::cli
