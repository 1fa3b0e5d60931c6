// Tachyon (J. Stone) as a reference engine: its own highlights by Phong, Blinn and Schlick, in double precision.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

/// Double, in pictures of float32. Tachyon takes the light away below N.L = 1/512.
inline constexpr EngineFloor kTachyonFloor{.of_peak = 2 * kFloat32Rounding,
                                           .least_cosine = 1.0 / 512};
inline constexpr EngineVariant kTachyonVariants[] = {
    {.name = "tachyon",
     .title = "Tachyon native",
     .shading = Shading::kNative,
     .floor = kTachyonFloor},
};

inline constexpr EngineInfo kTachyonInfo{
    .name = "tachyon",
    .title = "Tachyon",
    .install_hint = "sudo apt-get install libtachyon-mt-0-dev, and build Lobelia again",
    .supported_versions = "0.98 or 0.99",
    .shading =
        "native: Phong (RDF) with cos^n, Blinn-Phong (RDF) with cos^n or Schlick's lobe, grey",
    .precision = "double; pictures in float32, which round by 6e-8 of the value",
    .effects =
        "spheres, planes, directional lights, shadows; as averages: depth of field, antialiasing",
    .plain = "float",
    .floor = kTachyonFloor,
    .seconds = {0.02, 1e-6},
    .variants = kTachyonVariants,
};

std::unique_ptr<Engine> make_tachyon(const std::filesystem::path& program);
void keep_tachyon_input(const Scene& scene, const ReferenceOptions& options,
                        const std::filesystem::path& directory);

}  // namespace lobelia
