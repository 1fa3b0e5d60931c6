// OpenGL's lighting before shaders (OpenGL 1.0 to 2.1, "fixed function") as a reference engine: Blinn-Phong as it was in every
// graphics card for twenty years.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

/// The cosine is the product of two vectors in float32, of three components each; power and colour round some more.
inline constexpr EngineFloor kOpenglFloor{.of_peak = 8 * kFloat32Rounding,
                                          .of_cosine = 4 * kFloat32Rounding};
inline constexpr EngineVariant kOpenglVariants[] = {
    {.name = "opengl",
     .title = "OpenGL native",
     .shading = Shading::kNative,
     .floor = kOpenglFloor},
};

inline constexpr EngineInfo kOpenglInfo{
    .name = "opengl",
    .title = "OpenGL fixed function",
    .install_hint =
        "sudo apt-get install libegl-dev libgl-dev libgl1-mesa-dri, and build Lobelia again",
    .supported_versions = "1.5 to 4.6, with the compatibility profile",
    .shading = "native: Blinn-Phong (RDF) with cos^n, n at most 128, grey",
    .precision = "float32 throughout",
    .effects =
        "one sphere, up to 8 directional and point lights; as averages: depth of field, "
        "antialiasing",
    .plain = "float",
    .floor = kOpenglFloor,
    .seconds = {0.3, 1e-6},
    .variants = kOpenglVariants,
};

std::unique_ptr<Engine> make_opengl(const std::filesystem::path& program);
void keep_opengl_input(const Scene& scene, const ReferenceOptions& options,
                       const std::filesystem::path& directory);

}  // namespace lobelia
