// The subcommands, one file each. Each adds itself to the command line. Its callback throws Error or
// sets `exit_code`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "base/system/error.hpp"

namespace lobelia::cli {

/// By task, in the order of --help. A command is add_NAME() in a file of this folder, and its name here.
#define LOBELIA_COMMANDS(task, command)                                                        \
  task("Render a scene") command(render) command(reference) command(plan) command(scene)       \
      task("Compare pictures") command(compare) command(accept) command(profile)               \
          task("Render and compare many") command(farm) command(gallery)                       \
              task("Choose a highlight") command(models) command(search) command(cost)         \
                  command(convert) task("Write shaders") command(export) command(check_shader) \
                      task("Look something up") command(engines) command(scene_format)         \
                          command(records) task("Check Lobelia itself") command(verify)        \
                              command(manual)
#define LOBELIA_NO_TASK(title)
#define LOBELIA_DECLARE(name) void add_##name(CLI::App& app, ExitCode& exit_code);
LOBELIA_COMMANDS(LOBELIA_NO_TASK, LOBELIA_DECLARE)
#undef LOBELIA_DECLARE
#undef LOBELIA_NO_TASK

/// The command of the name `wanted` with -q and -v, or all of them if there is no such command: making all takes longer
/// than the work of many.
void add_commands(CLI::App& app, ExitCode& exit_code, const std::string& wanted = "");

/// The command line as typed, program name first; for records. Empty until the process fills it.
std::vector<std::string>& command_line();

}  // namespace lobelia::cli
