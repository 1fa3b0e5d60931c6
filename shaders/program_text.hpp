// The text around somebody's functions that makes a program of them.
#pragma once

#include <set>

#include "shaders/run_shaders.hpp"

namespace lobelia {

/// Texels of four floats for a point.
inline std::size_t texels_of_point(std::size_t components) { return (components + 3) / 4; }

/// The program's text, with its lines: a fragment shader for EGL, a compute shader for Vulkan.
ShaderProgram program_text(const ShaderSource& source, ShaderApi api, std::size_t points,
                           std::size_t components);

/// The names of the functions that a text defines, in any of the languages.
std::set<std::string> functions_in(std::string_view text);

/// A compiler's first error in one line: "mine.glsl:12: 'foo' : undeclared identifier".
std::string compiler_message(const std::string& log, const ShaderProgram& program);

}  // namespace lobelia
