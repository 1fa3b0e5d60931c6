// Which program of an engine was asked for.
#pragma once

#include <filesystem>
#include <string_view>

#include "cost/levels.hpp"

namespace lobelia::cost {

/// Empty where none was named: then it is the one in $PATH. "lobelia" is ourselves.
inline std::filesystem::path named_program(const Options& options, std::string_view engine) {
  for (const auto& [name, program] : options.programs)
    if (name == engine) return program;
  return engine == "lobelia" ? "/proc/self/exe" : "";
}

}  // namespace lobelia::cost
