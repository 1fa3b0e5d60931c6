#include <memory>

#include "base/system/files.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/manual/manual_tables.hpp"
#include "program/command/options.hpp"

namespace lobelia::cli {
namespace {

/// Where programs look for them, below /usr/share, /usr/local/share or ~/.local/share.
Files manual(const std::vector<CommandRow>& commands) {
  Files files;
  for (const CommandRow& command : commands)
    files[fmt::format("man/man1/{}.1", man_name(command))] = man_page(command, commands);
  files["bash-completion/completions/lobelia"] = bash_completion(commands);
  return files;
}

/// As they lie in docs/.
Files documentation(const std::vector<CommandRow>& commands) {
  Files files = models_documentation();
  files["command_line.md"] = command_line_page(commands);
  files["environment.md"] = environment_page();
  return files;
}

void write(const Files& files, const std::filesystem::path& directory) {
  for (const auto& [file, text] : files) {
    make_directories((directory / file).parent_path());
    write_file(directory / file, text);
  }
}

}  // namespace

void add_manual(CLI::App& app, ExitCode&) {
  auto* command =
      app.add_subcommand("manual", "Write man pages, and completions for bash, into a directory");
  auto share = std::make_shared<std::string>(), docs = std::make_shared<std::string>();
  OptionGroup group(*command);
  auto* output = add_common(group, "--output", *share,
                            ": such as ~/.local/share; existing files are replaced", "DIR");
  auto* pages =
      group.add("--docs", *docs, "DIR",
                "Write the generated pages of docs/ into DIR: command line, environment, models");
  command->footer("Example: lobelia manual -o ~/.local/share");
  command->callback([&app, share, docs, output, pages] {
    if (output->count() + pages->count() == 0) throw CLI::RequiredError("--output");
    const std::vector<CommandRow> commands = command_rows(app);
    if (!share->empty()) write(manual(commands), *share);
    if (!docs->empty()) write(documentation(commands), *docs);
  });
}

}  // namespace lobelia::cli
