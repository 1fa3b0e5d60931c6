#include "reference_scenes/engines/three/three.hpp"

#include <numbers>

#include "reference_scenes/engines/programs/browser_engine.hpp"
#include "reference_scenes/engines/programs/native_engine.hpp"

namespace lobelia {
namespace {

std::optional<OwnHighlight> three_highlight(const Highlight& highlight) {
  if (info(highlight.model).name != "blinn_phong_heightfield" ||
      info(highlight.lobe).name != "cosine")
    return {};
  const double own_coefficient = (highlight.exponent + 2) / (8 * std::numbers::pi);
  return OwnHighlight{"phong", radiance_coefficient(highlight) / own_coefficient};
}

std::string why_not_in_three(const Scene& scene) { return why_not_one_sphere(scene); }

constexpr NativeEngine kThree{
    kThreeInfo,
    {"engine_three", "three.js ", [](int major, int minor) { return major == 0 && minor == 187; },
     page_of, true},
    "three.js' own MeshPhongMaterial, one point with the sphere's normal for each pixel",
    three_highlight,
    why_not_in_three};

}  // namespace

std::unique_ptr<Engine> make_three(const std::filesystem::path& program) {
  return make_native_engine(kThree, program);
}

void keep_three_input(const Scene& scene, const ReferenceOptions& options,
                      const std::filesystem::path& directory) {
  keep_native_input(kThree, scene, options, directory);
}

}  // namespace lobelia
