// Babylon.js' StandardMaterial as a reference engine: Blinn-Phong without a coefficient.
#include <algorithm>
#include <cmath>

#include "reference_scenes/engines/programs/native_engine.hpp"
#include "renderer/pixel_ray.hpp"

namespace lobelia {
namespace {

constexpr EngineVariant kBabylonVariants[] = {
    {"babylon", "Babylon.js native", false, Shading::kNative, kFloat32PointFloor}};

/// (N.H)^n, without a coefficient.
std::optional<OwnHighlight> babylon_highlight(const Highlight& highlight) {
  if (info(highlight.model).name != "blinn_phong_rdf" || info(highlight.lobe).name != "cosine")
    return {};
  return OwnHighlight{"blinn", radiance_coefficient(highlight)};
}

/// The largest (N.H)^n of a light where the surface faces away from it and the camera sees it.
double leak(const Scene& scene) {
  double largest = 0;
  for_each_pixel_of(scene, 0, [&](std::size_t, const Hit& hit, Vec3 to_eye) {
    const double exponent =
        scene.materials.at(std::size_t(scene.spheres[0].material)).highlight.exponent;
    for (const Light& light : scene.lights) {
      const Vec3 to_light = illuminate(lamp_of(light), hit.point).to_light;
      if (dot(hit.normal, to_light) > 0) continue;
      const double cosine = dot(hit.normal, normalize(to_light + to_eye));
      largest = std::max(largest, std::pow(std::max(0.0, cosine), exponent));
    }
  });
  return largest;
}

std::string why_not_in_babylon(const Scene& scene) {
  if (std::string why = why_not_one_sphere(scene); !why.empty()) return why;
  if (has_point_lights(scene))
    return "its point lights do not fall off with the square of the distance";
  constexpr double kMostLeak = 1e-6;  // of the peak
  if (leak(scene) > kMostLeak)
    return "its highlight goes on where the surface faces away from the light";
  return "";
}

}  // namespace

constinit const NativeEngine kBabylon{
    {
        .name = "babylon",
        .title = "Babylon.js",
        .install_hint = "sudo apt-get install chromium npm, and build Lobelia again with make",
        .supported_versions = "9",
        .shading = "native: Blinn-Phong (RDF) with cos^n, grey",
        .precision = "float32 throughout, on SwiftShader",
        .effects = "one sphere, directional lights; as averages: depth of field, antialiasing",
        .plain = "float",
        .floor = kFloat32PointFloor,
        .seconds = {0.5, 2e-6},
        .variants = kBabylonVariants,
    },
    {"engine_babylon", "Babylon.js ", [](int major, int) { return major == 9; }, page_of, true},
    "Babylon.js' own StandardMaterial, one point with the sphere's normal for each pixel",
    babylon_highlight,
    why_not_in_babylon};

}  // namespace lobelia
