// lobelia verify paper
#pragma once

#include <CLI/CLI.hpp>

namespace lobelia::cli {

void add_verify_paper(CLI::App& verify);

}  // namespace lobelia::cli
