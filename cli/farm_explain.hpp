// lobelia farm explain
#pragma once

#include <CLI/CLI.hpp>

#include "core/error.hpp"

namespace lobelia::cli {

void add_farm_explain(CLI::App& farm, ExitCode& exit_code);

}  // namespace lobelia::cli
