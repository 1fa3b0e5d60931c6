// The subcommands, one file each. Each adds itself to the command line. Its callback throws Error or
// sets `exit_code`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace lobelia::cli {

/// In the order of --help. A command is add_NAME() in a file of this folder, and its name here.
#define LOBELIA_COMMANDS(command)                                                                \
  command(render) command(plan) command(models) command(scene) command(scene_format)             \
      command(export) command(convert) command(check_shader) command(engines) command(reference) \
          command(compare) command(profile) command(cost) command(search) command(farm)          \
              command(gallery) command(verify) command(records) command(manual)
#define LOBELIA_DECLARE(name) void add_##name(CLI::App& app, ExitCode& exit_code);
LOBELIA_COMMANDS(LOBELIA_DECLARE)
#undef LOBELIA_DECLARE

/// The command line as typed, program name first; for records.
const std::vector<std::string>& command_line();

}  // namespace lobelia::cli
