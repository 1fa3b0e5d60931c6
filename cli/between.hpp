// Numbers on the command line.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "core/text.hpp"

namespace lobelia::cli {

/// What an option's number has to be. CLI::Range would let a NaN pass, which is neither below `min` nor
/// above `max`.
inline CLI::Validator between(double min, double max) {
  return {[=](std::string& text) {
            double value = 0;
            if (parse_number(text, value) && value >= min && value <= max) return std::string();
            return fmt::format("'{}' is out of range; allowed: {:g} to {:g}", printable(text), min,
                               max);
          },
          fmt::format("{:g} to {:g}", min, max)};
}

}  // namespace lobelia::cli
