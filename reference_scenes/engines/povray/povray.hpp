// POV-Ray as a reference engine.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

/// A half float, from colours in float32. Near 0 half floats are subnormal.
inline constexpr EngineFloor kPovrayHalf{.of_value = kHalfRounding + 4 * kFloat32Rounding,
                                         .of_peak = 1e-8};
/// Two half floats leave 2^-22 of a value, and each comes from colours in float32.
inline constexpr EngineFloor kPovrayFloat{.of_value = 0x1p-22 + 4 * kFloat32Rounding};
inline constexpr EngineVariant kPovrayVariants[] = {
    {.name = "povray_native_half",
     .title = "POV-Ray native, half",
     .shading = Shading::kNative,
     .floor = kPovrayHalf,
     .rounding = 4.9e-4},
    {"povray_native_float", "POV-Ray native, float", true, Shading::kNative, kPovrayFloat},
    {"povray_expressed_half", "POV-Ray expressed, half", false, Shading::kReimplemented,
     kPovrayHalf},
    {"povray_expressed_float", "POV-Ray expressed, float", true, Shading::kReimplemented,
     kPovrayFloat},
};

inline constexpr EngineInfo kPovrayInfo{
    .name = "povray",
    .title = "POV-Ray",
    .install_hint = "sudo apt-get install povray",
    .supported_versions = "3.7 or 3.8",
    .shading =
        "native: Phong (RDF) and Blinn-Phong (RDF) with cos^n, grey and without Fresnel; "
        "expressed: all else, in its language",
    .precision =
        "half: rounds by up to 4.9e-4 of the value; float: by a second pass, which shows what the first "
        "rounded off",
    .effects =
        "spheres, planes and checkers, directional and point lights, shadows, mirrors where all is native; "
        "as averages: lights with a size, the sky, depth of field, antialiasing",
    .plain = "half",
    .fine = "float",
    .floor = kPovrayHalf,
    .seconds = {0.3, 5e-6},
    .variants = kPovrayVariants,
};

std::unique_ptr<Engine> make_povray(const std::filesystem::path& program);

/// Writes POV-Ray's input for `scene` into `directory`, which exists.
void keep_povray_input(const Scene& scene, const ReferenceOptions& options,
                       const std::filesystem::path& directory);

}  // namespace lobelia
