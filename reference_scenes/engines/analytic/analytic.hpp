// The formulas as a reference engine. formulas/ computes every pixel with its own geometry, visibility, mirrors and
// coefficients, and none of the renderer's kernels.
#pragma once

#include <filesystem>
#include <memory>

#include "reference_scenes/engine.hpp"

namespace lobelia {

inline constexpr EngineInfo kAnalyticInfo{
    .name = "analytic",
    .title = "Analytic",
    .install_hint = "nothing: it is part of lobelia",
    .supported_versions = "this one",
    .shading = "analytic: the formulas of all models, pixel by pixel",
    .precision = "double throughout, or 50 digits; float32 pictures",
    .effects =
        "spheres, planes and checkers, directional and point lights, shadows, mirrors; as averages: lights "
        "with a size, the sky, depth of field, antialiasing",
    .plain = "double",
    .fine = "fifty_digits",
    .is_program = false,
    .floor = {.of_peak = kFloat32Rounding},
    .seconds = {0.02, 2e-6},
};

/// Throws Error(kUsage) if a program is named, because there is none.
std::unique_ptr<Engine> make_analytic(const std::filesystem::path& program);

/// Writes the scene and the command that evaluates it into `directory`, which exists.
void keep_analytic_input(const Scene& scene, const ReferenceOptions& options,
                         const std::filesystem::path& directory);

}  // namespace lobelia
