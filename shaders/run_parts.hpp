// Shared by run_shaders.cpp, run_webgpu.cpp and spirv.cpp.
#pragma once

#include "core/process.hpp"
#include "shaders/run_shaders.hpp"

namespace lobelia {

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
