// What run_shaders.cpp and run_webgpu.cpp have in common.
#pragma once

#include "shaders/run_shaders.hpp"

namespace lobelia {

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
