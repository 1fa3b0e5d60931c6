// Blender at work: processes that are given one scene after the other.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reference_scenes/engine.hpp"
#include "reference_scenes/engines/blender/blender_input.hpp"

namespace lobelia {

inline constexpr char kBlenderScriptFile[] = "render_scenes.py";
inline constexpr char kBlenderJobFile[] = "job.json";

/// Without the user's start-up file and add-ons, and with Python's failures as failures.
/// `directory` holds script and job; Blender must be told where it is, because it believes $PWD
/// rather than its working directory.
std::vector<std::string> blender_arguments(const std::string& program,
                                           const std::filesystem::path& directory);
/// render_scenes.py and the modules that it imports.
void write_blender_scripts(const std::filesystem::path& directory);

std::unique_ptr<SimpleSession> open_blender(const EngineStatus& status,
                                            const ReferenceOptions& options);

}  // namespace lobelia
