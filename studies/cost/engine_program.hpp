// Which program of an engine was asked for.
#pragma once

#include <filesystem>
#include <string_view>

#include "studies/cost/benchmarks.hpp"

namespace lobelia::cost {

/// Empty where none was named: then it is the one in $PATH. "lobelia" is ourselves.
inline std::filesystem::path named_program(const Options& options, std::string_view engine) {
  for (const auto& [name, program] : options.programs)
    if (name == engine) return program;
  // Resolved here: in the keeper that starts it the link would lead to the keeper.
  return engine == "lobelia" ? std::filesystem::read_symlink("/proc/self/exe") : "";
}

}  // namespace lobelia::cost
