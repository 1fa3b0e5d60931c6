// Blender's Cycles as a reference engine.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

inline constexpr EngineInfo kBlenderInfo{
    .name = "blender",
    .title = "Blender Cycles",
    .install_hint = "sudo apt-get install blender",
    .supported_versions = "3.4 to 4.x",
    .witness =
        "expressed: all, in shader nodes; native (if asked for): half-vector models with cos^n, by the "
        "Ashikhmin-Shirley closure",
    .precision =
        "float32 throughout: 2e-5 of the peak up to n = 1024, 3e-4 at 1e6 (docs/agreement.md)",
    .effects =
        "spheres, planes and checkers, directional and point lights, shadows, mirrors; as averages: lights "
        "with a size, the sky, depth of field, antialiasing",
    .plain = "float",
};

std::unique_ptr<Engine> make_blender(const std::filesystem::path& program);

/// Writes what Blender is given for `scene` into `directory`, which exists.
void keep_blender_input(const Scene& scene, const ReferenceOptions& options,
                        const std::filesystem::path& directory);

}  // namespace lobelia
