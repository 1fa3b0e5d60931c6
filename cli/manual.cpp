#include <memory>

#include "cli/commands.hpp"
#include "cli/manual_tables.hpp"
#include "cli/options.hpp"
#include "core/files.hpp"

namespace lobelia::cli {
namespace {

/// Where programs look for them, below /usr/share, /usr/local/share or ~/.local/share.
void write_manual(const CLI::App& program, const std::filesystem::path& share) {
  const std::vector<CommandRow> commands = command_rows(program);
  const auto write = [&](const std::string& file, const std::string& text) {
    make_directories((share / file).parent_path());
    write_file(share / file, text);
  };
  for (const CommandRow& command : commands)
    write(fmt::format("man/man1/{}.1", man_name(command)), man_page(command, commands));
  write("bash-completion/completions/lobelia", bash_completion(commands));
  write("zsh/site-functions/_lobelia", zsh_completion(commands));
  write("fish/vendor_completions.d/lobelia.fish", fish_completion(commands));
}

}  // namespace

void add_manual(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "manual", "Write man pages, and completions for bash, zsh and fish, into a directory");
  auto share = std::make_shared<std::string>();
  OptionGroup(*command)
      .add("-o,--output", *share, "DIR",
           "Directory such as ~/.local/share; existing files are replaced")
      ->required();
  command->footer("Example: lobelia manual -o ~/.local/share");
  command->callback([&app, share] { write_manual(app, *share); });
}

}  // namespace lobelia::cli
