// Man pages and completions, by man itself and by the shells.
#include <regex>

#include "tests/packages/installed_tree.hpp"
#include "tests/test.hpp"

namespace packages {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string help_of(const std::string& command) {
  return installed_tree().shell("lobelia " + command + " --help").output;
}
std::set<std::string> matches(const std::string& text, const std::regex& word) {
  std::set<std::string> words;
  for (std::sregex_iterator it(text.begin(), text.end(), word), end; it != end; ++it)
    words.insert((*it)[1]);
  return words;
}
std::set<std::string> subcommands(const std::string& command) {
  const std::string help = help_of(command);
  // The commands of lobelia itself stand in groups, by task.
  const std::size_t at = help.find(command.empty() ? "\nOptions:\n" : "\nSubcommands:\n");
  if (at == help.npos) return {};
  const std::size_t end = help.find(command.empty() ? "\nBegin with:\n" : "\n\n", at + 1);
  static const std::regex word("\n  ([a-z][a-z-]+) ");
  return matches(help.substr(at, end - at), word);
}
std::set<std::string> options(const std::string& command) {
  static const std::regex word("\n  (?:-[a-zA-Z],)?(--[a-z][a-z0-9-]*)");
  return matches(help_of(command), word);
}

std::vector<std::string> all_commands() {
  std::vector<std::string> commands{""};
  for (std::size_t i = 0; i < commands.size(); ++i)
    for (const std::string& name : subcommands(commands[i]))
      commands.push_back(commands[i].empty() ? name : commands[i] + " " + name);
  EXPECT_GT(commands.size(), 20u);
  return commands;
}

TEST(ManPages, CoverEveryCommandAndOptionWithoutAWarning) {
  if (!has_program("man")) GTEST_SKIP() << "man-db is not installed";
  const fs::path pages = installed_tree().prefix() / "share/man/man1";
  for (const std::string& command : all_commands()) {
    SCOPED_TRACE(command);
    const std::string name =
        "lobelia" +
        (command.empty() ? "" : "-" + std::regex_replace(command, std::regex(" "), "-"));
    const std::string page = house::quoted(pages / (name + ".1.gz"));
    const Ran shown = run("MANWIDTH=200 LC_ALL=C.UTF-8 man -l " + page + " | col -bx");
    for (const std::string& option : options(command)) EXPECT_THAT(shown.output, HasSubstr(option));
    const Ran warnings =
        run("LC_ALL=C.UTF-8 MANROFFSEQ= MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z " + page +
            " 2>&1 > /dev/null");
    EXPECT_EQ(warnings.exit_code, 0);
    EXPECT_THAT(warnings.output, IsEmpty());
    const Ran whatis = run("lexgrog " + page);
    EXPECT_EQ(whatis.exit_code, 0);
    EXPECT_THAT(whatis.output, HasSubstr(": \"" + name + " - "));
  }
}

/// The completions of the last word of `line`.
std::set<std::string> completed(const std::string& line) {
  const std::string script =
      "source \"$PREFIX\"/share/bash-completion/completions/lobelia; compopt() { :; }; "
      "read -ra COMP_WORDS <<< \"$1\"; [[ $1 != *\" \" ]] || COMP_WORDS+=(\"\"); "
      "COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _lobelia; printf \"%s\\n\" \"${COMPREPLY[@]}\"";
  const Ran ran = installed_tree().shell("bash --norc -euc " + house::quoted(script) + " bash " +
                                         house::quoted(line));
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  const auto lines = house::lines(ran.output);
  std::set<std::string> words(lines.begin(), lines.end());
  words.erase("");
  return words;
}

TEST(Completion, KnowsEveryCommandAndOptionInBash) {
  for (const std::string& command : all_commands()) {
    const std::string line = "lobelia " + command + (command.empty() ? "" : " ");
    SCOPED_TRACE(line);
    const auto of_blank = completed(line), of_dash = completed(line + "--");
    for (const std::string& name : subcommands(command))
      EXPECT_TRUE(of_blank.contains(name)) << name;
    for (const std::string& name : options(command)) EXPECT_TRUE(of_dash.contains(name)) << name;
  }
  EXPECT_EQ(completed("lobelia rend"), std::set<std::string>{"render"});
  EXPECT_EQ(completed("lobelia render --effects "),
            (std::set<std::string>{"all", "as-called-for"}));
  // Options of the command before the last one.
  EXPECT_FALSE(completed("lobelia farm status --").contains("--effects"));
}

}  // namespace
}  // namespace packages
