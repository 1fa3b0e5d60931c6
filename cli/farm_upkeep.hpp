// lobelia farm status | verify | gc | clean
#pragma once

#include <CLI/CLI.hpp>

#include "core/error.hpp"

namespace lobelia::cli {

void add_farm_upkeep(CLI::App& farm, ExitCode& exit_code);

}  // namespace lobelia::cli
