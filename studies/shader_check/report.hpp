// A check of a shader as a text and as a page.
#pragma once

#include <string>

#include "studies/shader_check/check.hpp"

namespace lobelia::shader_check {

std::string report_text(const records::ShaderCheck& record);

/// One HTML file, without a script and with its pictures in it.
std::string report_page(const Check& check);

}  // namespace lobelia::shader_check
