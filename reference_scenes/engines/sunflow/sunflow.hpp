// Sunflow (C. Kulla) as a reference engine: modified Phong with a coefficient of its own, (n + 2) / (2 pi).
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

/// All in float32: the place of a point, by a quadratic that loses most beside the silhouette, its normal, and the cosine from
/// two more vectors and their product.
inline constexpr EngineFloor kSunflowFloor{.of_peak = 16 * kFloat32Rounding,
                                           .of_quadratic = 3 * kFloat32Rounding,
                                           .of_cosine = 12 * kFloat32Rounding};
inline constexpr EngineVariant kSunflowVariants[] = {
    {.name = "sunflow",
     .title = "Sunflow native",
     .shading = Shading::kNative,
     .floor = kSunflowFloor},
};

inline constexpr EngineInfo kSunflowInfo{
    .name = "sunflow",
    .title = "Sunflow",
    .install_hint = "sudo apt-get install libsunflow-java default-jre-headless",
    .supported_versions = "0.07",
    .shading =
        "native: modified Phong with cos^n and the exact coefficient, which is its own; grey",
    .precision = "float32 throughout, places of points included",
    .effects =
        "spheres, planes, directional lights, shadows; as averages: depth of field, antialiasing",
    .plain = "float",
    .floor = kSunflowFloor,
    .seconds = {1.2, 3e-6},
    .variants = kSunflowVariants,
};

std::unique_ptr<Engine> make_sunflow(const std::filesystem::path& program);
void keep_sunflow_input(const Scene& scene, const ReferenceOptions& options,
                        const std::filesystem::path& directory);

}  // namespace lobelia
