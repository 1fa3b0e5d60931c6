// Blender's Cycles as a reference engine.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

inline constexpr ExponentTarget kBlenderReimplemented[] = {{1024, {false, 1.1e-5}},
                                                           {1e5, {false, 7e-5}}},
                                kBlenderNative[] = {{1024, {false, 1.3e-4}}, {1e5, {false, 3e-3}}};
inline constexpr EngineVariant kBlenderVariants[] = {
    {.name = "blender_expressed",
     .title = "Blender expressed",
     .shading = Shading::kReimplemented,
     .targets = kBlenderReimplemented,
     .why_off =
         "Cycles has the place of a point in float32, some 1e-7 of the sphere's radius off, and more where it is "
         "seen at a grazing angle, on a small sphere or from afar (5 radii in pictures of the whole sphere). The "
         "normal is as far off, the lobe's angle up to twice as far, and a lobe falls by up to 0.6 sqrt(n) of "
         "its peak per radian: 4e-5 at n = 1e5, before any of these.",
     .rounding = 1e-4},
    {.name = "blender_native",
     .title = "Blender native",
     .shading = Shading::kNative,
     .targets = kBlenderNative,
     .why_off =
         "Cycles' closure takes the n-th power of N.H, and a float32 below 1 is 6e-8 from the next: for each "
         "rounding n times that, 6e-3 of the value at n = 1e5. So far off, it is off in the ring, too."},
};

inline constexpr EngineInfo kBlenderInfo{
    .name = "blender",
    .title = "Blender Cycles",
    .install_hint = "sudo apt-get install blender",
    .supported_versions = "3.4 to 4.x",
    .shading =
        "expressed: all, in shader nodes; native (if asked for): half-vector models with cos^n, by the "
        "Ashikhmin-Shirley closure",
    .precision =
        "float32 throughout: 2e-5 of the peak up to n = 1024, 3e-4 at 1e6 (docs/agreement.md)",
    .effects =
        "spheres, planes and checkers, directional and point lights, shadows, mirrors; as averages: lights "
        "with a size, the sky, depth of field, antialiasing",
    .plain = "float",
    // Float32 throughout; agreement_test.cpp measures 2.0e-5.
    .tolerance = {0, 3e-5},
    .seconds = {0.15, 2e-6},
    .variants = kBlenderVariants,
    .transport = "Cycles",
};

std::unique_ptr<Engine> make_blender(const std::filesystem::path& program);

/// Writes Blender's input for `scene` into `directory`, which exists.
void keep_blender_input(const Scene& scene, const ReferenceOptions& options,
                        const std::filesystem::path& directory);

}  // namespace lobelia
