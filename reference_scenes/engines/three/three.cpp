// three.js' MeshPhongMaterial as a reference engine: Blinn-Phong of a heightfield with a coefficient of its own,
// (n + 2) / (8 pi).
#include <numbers>

#include "reference_scenes/engines/programs/native_engine.hpp"

namespace lobelia {
namespace {

constexpr EngineVariant kThreeVariants[] = {
    {"three", "three.js native", false, Shading::kNative, kFloat32PointFloor}};

std::optional<OwnHighlight> three_highlight(const Highlight& highlight) {
  if (info(highlight.model).name != "blinn_phong_heightfield" ||
      info(highlight.lobe).name != "cosine")
    return {};
  const double own_coefficient = (highlight.exponent + 2) / (8 * std::numbers::pi);
  return OwnHighlight{"phong", radiance_coefficient(highlight) / own_coefficient};
}

}  // namespace

constinit const NativeEngine kThree{
    {
        .name = "three",
        .title = "three.js",
        .install_hint = "sudo apt-get install chromium npm, and build Lobelia again with make",
        .supported_versions = "0.187",
        .shading =
            "native: Blinn-Phong (heightfield) with cos^n and the exact coefficient, which is its own; grey",
        .precision = "float32 throughout, on SwiftShader",
        .effects =
            "one sphere, directional and point lights; as averages: lights with a size, the sky, depth of field, antialiasing",
        .plain = "float",
        .floor = kFloat32PointFloor,
        .seconds = {0.5, 2e-6},
        .variants = kThreeVariants,
    },
    {"engine_three", "three.js ", [](int major, int minor) { return major == 0 && minor == 187; },
     page_of, true},
    "three.js' own MeshPhongMaterial, one point with the sphere's normal for each pixel",
    three_highlight,
    why_not_one_sphere};

}  // namespace lobelia
