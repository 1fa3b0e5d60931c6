// The subcommands: one file each. Each adds itself to the command line; its callback throws Error or
// sets `exit_code`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace lobelia::cli {

void add_render(CLI::App& app, ExitCode& exit_code);
void add_plan(CLI::App& app, ExitCode& exit_code);
void add_models(CLI::App& app, ExitCode& exit_code);
void add_scene_format(CLI::App& app, ExitCode& exit_code);
void add_export(CLI::App& app, ExitCode& exit_code);
void add_engines(CLI::App& app, ExitCode& exit_code);
void add_reference(CLI::App& app, ExitCode& exit_code);
void add_compare(CLI::App& app, ExitCode& exit_code);
void add_profile(CLI::App& app, ExitCode& exit_code);
void add_cost(CLI::App& app, ExitCode& exit_code);
void add_farm(CLI::App& app, ExitCode& exit_code);
void add_gallery(CLI::App& app, ExitCode& exit_code);
void add_verify(CLI::App& app, ExitCode& exit_code);
void add_records(CLI::App& app, ExitCode& exit_code);

/// What the user typed, program name first; for records.
const std::vector<std::string>& command_line();

}  // namespace lobelia::cli
