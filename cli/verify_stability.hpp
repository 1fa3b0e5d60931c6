// lobelia verify stability
#pragma once

#include <CLI/CLI.hpp>

#include "core/error.hpp"

namespace lobelia::cli {

void add_verify_stability(CLI::App& verify, ExitCode& exit_code);

}  // namespace lobelia::cli
