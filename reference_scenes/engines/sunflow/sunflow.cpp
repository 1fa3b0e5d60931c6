// Sunflow (C. Kulla) as a reference engine: modified Phong with a coefficient of its own, (n + 2) / (2 pi).
#include <numbers>

#include "reference_scenes/engines/programs/native_engine.hpp"

namespace lobelia {
namespace {

/// All in float32: the place of a point, by a quadratic that loses most beside the silhouette, its normal, and the cosine
/// from two more vectors and their product.
constexpr EngineFloor kSunflowFloor{.of_peak = 16 * kFloat32Rounding,
                                    .of_quadratic = 3 * kFloat32Rounding,
                                    .of_cosine = 12 * kFloat32Rounding};
constexpr EngineVariant kSunflowVariants[] = {
    {"sunflow", "Sunflow native", false, Shading::kNative, kSunflowFloor}};

std::optional<OwnHighlight> sunflow_highlight(const Highlight& highlight) {
  if (info(highlight.model).name != "modified_phong" || info(highlight.lobe).name != "cosine")
    return {};
  const double own_coefficient = (highlight.exponent + 2) / (2 * std::numbers::pi);
  return OwnHighlight{"phong", radiance_coefficient(highlight) / own_coefficient};
}

/// engine_sunflow is a script: what it starts decides its pictures, too.
std::vector<std::filesystem::path> further_files(const std::filesystem::path& program,
                                                 std::string_view) {
  return {program.parent_path() / "engine_sunflow.java", "/usr/share/java/sunflow.jar"};
}

std::string why_not_in_sunflow(const Scene& scene) {
  return has_point_lights(scene) ? "the directions to its point lights are up to 1e-3 off" : "";
}

}  // namespace

constinit const NativeEngine kSunflow{
    {
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
    },
    {"engine_sunflow", "Sunflow ", [](int major, int minor) { return major == 0 && minor == 7; },
     further_files, true},
    "Sunflow's own Phong shader, by its library",
    sunflow_highlight,
    why_not_in_sunflow};

}  // namespace lobelia
