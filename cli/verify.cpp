#include "cli/commands.hpp"
#include "cli/verify_paper.hpp"
#include "cli/verify_references.hpp"
#include "cli/verify_stability.hpp"

namespace lobelia::cli {

void add_verify(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand("verify", "Hold claims to a measurement");
  command->require_subcommand(1);
  command->footer(
      "Begin with:\n  lobelia verify paper\n  lobelia verify stability\n"
      "  lobelia verify references --small");
  add_verify_paper(*command);
  add_verify_stability(*command, exit_code);
  add_verify_references(*command, exit_code);
}

}  // namespace lobelia::cli
