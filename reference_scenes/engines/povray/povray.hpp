// POV-Ray as a reference engine.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

inline constexpr ExponentTarget kPovrayHalf[] = {{kMaxExponent, {true, 4.9e-4}}},
                                kPovrayFloat[] = {{kMaxExponent, {true, 2.3e-7}}};
inline constexpr std::string_view kTwoHalves =
    "Two half floats leave 2^-22 = 2.4e-7 of a value, and POV-Ray has colours in float32 on the way to "
    "each, with 6e-8 for every operation.";
inline constexpr EngineVariant kPovrayVariants[] = {
    {.name = "povray_native_half",
     .title = "POV-Ray native, half",
     .shading = Shading::kNative,
     .targets = kPovrayHalf,
     .rounding = 4.9e-4},
    {"povray_native_float", "POV-Ray native, float", true, Shading::kNative, kPovrayFloat,
     kTwoHalves},
    {"povray_expressed_half", "POV-Ray expressed, half", false, Shading::kReimplemented,
     kPovrayHalf},
    {"povray_expressed_float", "POV-Ray expressed, float", true, Shading::kReimplemented,
     kPovrayFloat, kTwoHalves},
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
    // Half floats round by 2^-11 = 4.9e-4 of the value; near 0 they are subnormal.
    .tolerance = {6e-4, 1e-8},
    .seconds = {0.3, 5e-6},
    .variants = kPovrayVariants,
};

std::unique_ptr<Engine> make_povray(const std::filesystem::path& program);

/// Writes POV-Ray's input for `scene` into `directory`, which exists.
void keep_povray_input(const Scene& scene, const ReferenceOptions& options,
                       const std::filesystem::path& directory);

}  // namespace lobelia
