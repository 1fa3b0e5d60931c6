// What an exported highlight is called.
#pragma once

#include <string>

#include "renderer/highlight.hpp"

namespace lobelia {

/// "lobelia_modified_phong_cs16", with "_paper" for that normalisation, and with "_n64" for an exponent
/// that is fixed: the name of the function, and of its file.
std::string function_name(const Highlight& highlight, bool fixed_exponent = false);

/// "Modified_Phong" out of "modified_phong".
std::string capitalised(std::string_view name);

/// What "Romanyuk et al." is, for a reader who has only the exported file.
inline constexpr std::string_view kPaper =
    "Romanyuk et al.: O. N. Romanyuk, I. V. Abramchuk, S. A. Kyrylashchuk, S. O. Romanyuk, Modelling\n"
    "// of a specular component of colour by using energy-correct models of surface reflectivity\n"
    "// (Vinnytsia National Technical University).";

/// `modified Phong with the lobe cs16, normalisation "exact"`
std::string heading(const Highlight& highlight);

}  // namespace lobelia
