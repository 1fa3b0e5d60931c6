// What an exported highlight is called.
#pragma once

#include <string>

#include "renderer/highlight.hpp"

namespace lobelia {

/// "lobelia_modified_phong_cs16", with "_paper" for that normalisation: the name of the function, and
/// of its file. The exponent of `highlight` does not matter.
std::string function_name(const Highlight& highlight);

/// "Modified_Phong" out of "modified_phong".
std::string capitalised(std::string_view name);

/// `modified Phong with the lobe cs16, normalisation "exact"`
std::string heading(const Highlight& highlight);

}  // namespace lobelia
