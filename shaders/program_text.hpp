// The text around somebody's functions that makes a program of them.
#pragma once

#include <set>

#include "shaders/run_shaders.hpp"

namespace lobelia {

/// Texels of four floats for a point.
inline std::size_t texels_of_point(std::size_t components) { return (components + 3) / 4; }

/// The text with a blank for each comment, in UTF-8 without a byte order mark, with '\n' as the only line end and, but for
/// WGSL, each line that ends with '\\' joined to the next. So a directive is what begins a line with '#', whatever stands
/// around it. A string of HLSL has no comments. Lines keep their numbers. Throws Error(kInput), naming file and line, for
/// #include and for a comment that does not end, and naming the file for zero bytes.
std::string plain_text(const ShaderSource& source);

/// The program's text, with its lines: a fragment shader for EGL, a compute shader for Vulkan. Throws as plain_text().
ShaderProgram program_text(const ShaderSource& source, ShaderApi api, std::size_t points,
                           std::size_t components);

/// The names of the functions that a plain text defines, in any of the languages.
std::set<std::string> functions_in(std::string_view plain);

/// A compiler's first error in one line: "mine.glsl:12: 'foo' : undeclared identifier".
std::string compiler_message(const std::string& log, const ShaderProgram& program);

}  // namespace lobelia
