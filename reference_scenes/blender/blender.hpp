// Blender's Cycles as a reference engine.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

inline constexpr EngineInfo kBlenderInfo{"blender", "Blender Cycles",
                                         "sudo apt-get install blender"};

std::unique_ptr<Engine> make_blender(const std::filesystem::path& program);

/// Writes what Blender is given for `scene` into `directory`, which exists.
void keep_blender_input(const Scene& scene, const std::filesystem::path& directory);

}  // namespace lobelia
