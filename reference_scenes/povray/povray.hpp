// POV-Ray as a reference engine.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

inline constexpr EngineInfo kPovrayInfo{
    .name = "povray",
    .title = "POV-Ray",
    .install_hint = "sudo apt-get install povray",
    .supported_versions = "3.7 or 3.8",
    .witness =
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
};

std::unique_ptr<Engine> make_povray(const std::filesystem::path& program);

/// Writes what POV-Ray is given for `scene` into `directory`, which exists.
void keep_povray_input(const Scene& scene, const ReferenceOptions& options,
                       const std::filesystem::path& directory);

}  // namespace lobelia
