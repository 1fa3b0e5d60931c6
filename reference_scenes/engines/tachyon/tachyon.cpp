// Tachyon (J. Stone) as a reference engine: its own highlights by Phong, Blinn and Schlick, in double precision.
#include "reference_scenes/engines/programs/native_engine.hpp"

namespace lobelia {
namespace {

/// Double, in pictures of float32. Tachyon takes the light away below N.L = 1/512.
constexpr EngineFloor kTachyonFloor{.of_peak = 2 * kFloat32Rounding, .least_cosine = 1.0 / 512};
constexpr EngineVariant kTachyonVariants[] = {
    {"tachyon", "Tachyon native", false, Shading::kNative, kTachyonFloor}};

/// None of Tachyon's highlights has a coefficient, nor a cosine.
std::optional<OwnHighlight> tachyon_highlight(const Highlight& highlight) {
  const std::string_view model = info(highlight.model).name, lobe = info(highlight.lobe).name;
  const double strength = radiance_coefficient(highlight);
  if (model == "phong_rdf" && lobe == "cosine") return OwnHighlight{"phong", strength};
  if (model == "blinn_phong_rdf" && lobe == "cosine") return OwnHighlight{"blinn", strength};
  if (model == "blinn_phong_rdf" && lobe == "schlick") return OwnHighlight{"schlick", strength};
  return {};
}

std::string why_not_in_tachyon(const Scene& scene) {
  if (has_point_lights(scene)) return "its highlights do not fall off with the distance of a light";
  std::string_view kind;
  for (const Material& material : scene.materials) {
    if (!has_highlight(material)) continue;
    const auto own = tachyon_highlight(material.highlight);
    if (!kind.empty() && kind != own->kind) return "all highlights of its scenes are of one kind";
    kind = own->kind;
  }
  return "";
}

}  // namespace

constinit const NativeEngine kTachyon{
    {
        .name = "tachyon",
        .title = "Tachyon",
        .install_hint = "sudo apt-get install libtachyon-mt-0-dev, and build Lobelia again",
        .supported_versions = "0.98 or 0.99",
        .shading =
            "native: Phong (RDF) with cos^n, Blinn-Phong (RDF) with cos^n or Schlick's lobe, grey",
        .precision = "double; pictures in float32, which round by 6e-8 of the value",
        .effects =
            "spheres, planes, directional lights, shadows; as averages: depth of field, antialiasing",
        .plain = "float",
        .floor = kTachyonFloor,
        .seconds = {0.02, 1e-6},
        .variants = kTachyonVariants,
    },
    {"engine_tachyon", "Tachyon ", [](int major, int minor) { return major == 0 && minor >= 98; },
     nullptr, true},
    "Tachyon's own highlight, by its library",
    tachyon_highlight,
    why_not_in_tachyon};

}  // namespace lobelia
