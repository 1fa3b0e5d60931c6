#include "reference_scenes/engines/tachyon/tachyon.hpp"

#include "reference_scenes/engines/programs/native_engine.hpp"

namespace lobelia {
namespace {

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

constexpr NativeEngine kTachyon{
    kTachyonInfo,
    {"engine_tachyon", "Tachyon ", [](int major, int minor) { return major == 0 && minor >= 98; },
     nullptr, true},
    "Tachyon's own highlight, by its library",
    tachyon_highlight,
    why_not_in_tachyon};

}  // namespace

std::unique_ptr<Engine> make_tachyon(const std::filesystem::path& program) {
  return make_native_engine(kTachyon, program);
}

void keep_tachyon_input(const Scene& scene, const ReferenceOptions& options,
                        const std::filesystem::path& directory) {
  keep_native_input(kTachyon, scene, options, directory);
}

}  // namespace lobelia
