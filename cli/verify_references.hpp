// lobelia verify references
#pragma once

#include <CLI/CLI.hpp>

#include "core/error.hpp"

namespace lobelia::cli {

void add_verify_references(CLI::App& verify, ExitCode& exit_code);

}  // namespace lobelia::cli
