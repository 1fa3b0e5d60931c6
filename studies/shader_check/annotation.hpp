// Tells GitHub Actions what differs, in a line that it shows beside the line of the shader.
#pragma once

#include <span>
#include <string>

#include "base/records/shader_check.hpp"
#include "studies/shader_check/run_shaders.hpp"

namespace lobelia::shader_check {

/// The line, from 1, of the term that the mistakes are about: the coefficient's, by its pi, or the power's. Where no line
/// or several have it, that of the function's last return; 0 if the text does not define the function.
std::size_t line_of_term(const ShaderSource& source, std::string_view function,
                         std::span<const std::string> mistakes);

/// "::error file=...,line=...::..." of a shader that differs; "" of one that passes.
std::string annotation_text(const records::ShaderCheck& record, const ShaderSource& source);

}  // namespace lobelia::shader_check
