// What the hard cases are hard on, for readers.
#pragma once

#include <string_view>

namespace lobelia::stability {

std::string_view meaning_of_group(std::string_view group);
/// "" where the name says it.
std::string_view meaning_of_case(std::string_view group, std::string_view name);

}  // namespace lobelia::stability
