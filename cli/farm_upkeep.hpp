// lobelia farm status | verify | gc | clean | explain
#pragma once

#include <CLI/CLI.hpp>

#include "core/error.hpp"

namespace lobelia::cli {

void add_farm_upkeep(CLI::App& farm, ExitCode& exit_code);
void add_farm_explain(CLI::App& farm, ExitCode& exit_code);

}  // namespace lobelia::cli
