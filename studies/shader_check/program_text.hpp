// The text around somebody's functions that makes a program of them.
#pragma once

#include "base/system/error.hpp"
#include "base/system/process.hpp"
#include "studies/shader_check/run_shaders.hpp"

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

/// The #version of a text; "" if it has none.
std::string version_directive(const ShaderSource& source);

/// A compiler's first error in one line: "mine.glsl:12: 'foo' : undeclared identifier". Error(kEngine) for Lobelia's own
/// program, unless the driver lacks the version that somebody's shader asks for.
Error refusal(const std::string& log, const ShaderProgram& program);
/// "mine.glsl: the shader", for messages.
std::string words_for(const ShaderProgram& program);

// Shared by run_shaders.cpp, run_webgpu.cpp and spirv.cpp.

/// An exit code over this is 128 + the signal that ended the program.
inline constexpr int kSignalBase = 128;

/// run_process() for what is left of the limit. Once that is over nothing is started, and the result has timed out.
ProcessResult run_within(const TimeLimit& limit, const std::vector<std::string>& command,
                         ProcessOptions options);

/// 32 random digits, which no shader can know and so none can say.
std::string random_token();

/// The components of all points, padded to texels of four floats.
std::vector<float> texels_of(const ShaderPoints& points);

/// Values from a driver's four floats for each invocation, of which `bytes` has enough.
std::vector<ShaderValue> shader_values(std::string_view bytes, std::size_t count);

/// Whether there is a device that a driver has to open for writing.
bool has_graphics_hardware();

/// As run_programs(), in Debian's Chromium without a window.
ShaderRun run_in_browser(const ShaderPoints& points, const std::vector<ShaderProgram>& programs,
                         std::size_t calls, const ShaderRunOptions& options);

}  // namespace lobelia
