#include "reference_scenes/engines/sunflow/sunflow.hpp"

#include <numbers>

#include "reference_scenes/engines/programs/native_engine.hpp"

namespace lobelia {
namespace {

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

constexpr NativeEngine kSunflow{
    kSunflowInfo,
    {"engine_sunflow", "Sunflow ", [](int major, int minor) { return major == 0 && minor == 7; },
     further_files, true},
    "Sunflow's own Phong shader, by its library",
    sunflow_highlight,
    why_not_in_sunflow};

}  // namespace

std::unique_ptr<Engine> make_sunflow(const std::filesystem::path& program) {
  return make_native_engine(kSunflow, program);
}

void keep_sunflow_input(const Scene& scene, const ReferenceOptions& options,
                        const std::filesystem::path& directory) {
  keep_native_input(kSunflow, scene, options, directory);
}

}  // namespace lobelia
