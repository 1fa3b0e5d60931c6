// Texts of records as the pages show them: formulas typeset.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/words/html.hpp"

namespace lobelia::gallery {

/// Formulas as they are printed: "cos^n" is "cosⁿ", "6/sqrt(n)" is "6/√n", "1.7e-2" is "1.7 × 10⁻²", "theta_cr" is
/// "θ_cr". For attributes and charts, which have no raised letters beyond Unicode's.
std::string math_text(std::string_view text);
/// The same as the content of an element, with <sup> and <sub>.
void write_math(Html& html, std::string_view text);
/// An element with such a content.
void math_element(Html& html, std::string_view tag, std::string_view text);
void math_element(Html& html, std::string_view tag, const Attributes& attributes,
                  std::string_view text);

/// "spherical gaussian, stable": a name of a record, for people.
std::string spoken_name(std::string_view name);

}  // namespace lobelia::gallery
