// Blender's Cycles as a reference engine.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reference_scenes/engine.hpp"
#include "reference_scenes/persistent_session.hpp"

namespace lobelia {

/// Cycles has the ray, its length and the place of a point in float32. Colours go through some nodes in float32; where
/// the surface is seen at a grazing angle, they are off by 1e-5 of the peak.
inline constexpr EngineFloor kBlenderExpressed{.of_peak = 1e-5, .of_place = 3 * kFloat32Rounding};
/// The closure takes the n-th power of N.H, the product of two vectors in float32.
inline constexpr EngineFloor kBlenderNative{
    .of_peak = 1e-5, .of_place = kFloat32Rounding, .of_cosine = 4 * kFloat32Rounding};
inline constexpr EngineVariant kBlenderVariants[] = {
    {.name = "blender_expressed",
     .title = "Blender expressed",
     .shading = Shading::kReimplemented,
     .floor = kBlenderExpressed,
     .rounding = 1e-4},
    {.name = "blender_native",
     .title = "Blender native",
     .shading = Shading::kNative,
     .floor = kBlenderNative},
};

inline constexpr EngineInfo kBlenderInfo{
    .name = "blender",
    .title = "Blender Cycles",
    .install_hint = "sudo apt-get install blender",
    .supported_versions = "3.4 to 4.x",
    .shading =
        "expressed: all, in shader nodes; native (if asked for): half-vector models with cos^n or GGX, by the "
        "closures of that name",
    .precision =
        "float32 throughout: 2e-5 of the peak up to n = 1024, 3e-4 at 1e6 (docs/agreement.md)",
    .effects =
        "spheres, planes and checkers, directional and point lights, shadows, mirrors; as averages: lights "
        "with a size, the sky, depth of field, antialiasing",
    .plain = "float",
    .floor = kBlenderExpressed,
    .seconds = {0.15, 2e-6},
    .variants = kBlenderVariants,
    .transport = "Cycles",
};

std::unique_ptr<Engine> make_blender(const std::filesystem::path& program);

/// Writes Blender's input for `scene` into `directory`, which exists.
void keep_blender_input(const Scene& scene, const ReferenceOptions& options,
                        const std::filesystem::path& directory);

/// A scene written down for render_scenes.py: numbers and enumerations. Nothing that a user typed into the scene file
/// (ids, paths) gets in, so none of it can become code. Its text is one entry of the job's "scenes". `scene` is in engine
/// units (preparation.hpp). `native` calls for highlights that Cycles' own closure can shade. Throws Error(kEngine) for
/// what Blender cannot render.
SceneInput blender_input(const Scene& scene, const std::string& name, bool native = false);

}  // namespace lobelia
