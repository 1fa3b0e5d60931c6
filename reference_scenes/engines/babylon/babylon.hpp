// Babylon.js' StandardMaterial as a reference engine: Blinn-Phong without a coefficient.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

/// The cosine is the product of two vectors in float32, of three components each; power and colour round some more.
inline constexpr EngineFloor kBabylonFloor{.of_peak = 8 * kFloat32Rounding,
                                           .of_cosine = 4 * kFloat32Rounding};
inline constexpr EngineVariant kBabylonVariants[] = {
    {.name = "babylon",
     .title = "Babylon.js native",
     .shading = Shading::kNative,
     .floor = kBabylonFloor},
};

inline constexpr EngineInfo kBabylonInfo{
    .name = "babylon",
    .title = "Babylon.js",
    .install_hint = "sudo apt-get install chromium npm, and build Lobelia again with make",
    .supported_versions = "9",
    .shading = "native: Blinn-Phong (RDF) with cos^n, grey",
    .precision = "float32 throughout, on SwiftShader",
    .effects = "one sphere, directional lights; as averages: depth of field, antialiasing",
    .plain = "float",
    .floor = kBabylonFloor,
    .seconds = {0.5, 2e-6},
    .variants = kBabylonVariants,
};

std::unique_ptr<Engine> make_babylon(const std::filesystem::path& program);
void keep_babylon_input(const Scene& scene, const ReferenceOptions& options,
                        const std::filesystem::path& directory);

}  // namespace lobelia
