// three.js' MeshPhongMaterial as a reference engine: Blinn-Phong of a heightfield with a coefficient of its own,
// (n + 2) / (8 pi).
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

/// The cosine is the product of two vectors in float32, of three components each; power and colour round some more.
inline constexpr EngineFloor kThreeFloor{.of_peak = 8 * kFloat32Rounding,
                                         .of_cosine = 4 * kFloat32Rounding};
inline constexpr EngineVariant kThreeVariants[] = {
    {.name = "three",
     .title = "three.js native",
     .shading = Shading::kNative,
     .floor = kThreeFloor},
};

inline constexpr EngineInfo kThreeInfo{
    .name = "three",
    .title = "three.js",
    .install_hint = "sudo apt-get install chromium npm, and build Lobelia again with make",
    .supported_versions = "0.187",
    .shading =
        "native: Blinn-Phong (heightfield) with cos^n and the exact coefficient, which is its own; grey",
    .precision = "float32 throughout, on SwiftShader",
    .effects =
        "one sphere, directional and point lights; as averages: lights with a size, the sky, depth of field, antialiasing",
    .plain = "float",
    .floor = kThreeFloor,
    .seconds = {0.5, 2e-6},
    .variants = kThreeVariants,
};

std::unique_ptr<Engine> make_three(const std::filesystem::path& program);
void keep_three_input(const Scene& scene, const ReferenceOptions& options,
                      const std::filesystem::path& directory);

}  // namespace lobelia
