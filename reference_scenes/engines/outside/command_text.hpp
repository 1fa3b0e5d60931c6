// The text of an outside engine's command.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

/// The text with each {name} replaced by `value_of(name)`; {{ is a brace. Throws std::runtime_error for a brace without its
/// other, and whatever `value_of` throws.
std::string filled_in(std::string_view text,
                      const std::function<std::string(std::string_view name)>& value_of);

/// Arguments out of a line: blanks divide them, quotation marks of both kinds keep blanks. Throws std::runtime_error for a
/// mark that is not closed, or what only a shell would understand, such as a lone '|'.
std::vector<std::string> arguments_of(std::string_view line);

}  // namespace lobelia
