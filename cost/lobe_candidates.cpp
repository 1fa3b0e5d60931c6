#include "cost/lobe_candidates.hpp"

#include <algorithm>

namespace lobelia::cost {

Scene with_lobe(const Scene& scene, LobeId lobe) {
  Scene changed = scene;
  for (Material& material : changed.materials) {
    if (material.highlight.lobe == lobe) continue;
    material.highlight.lobe = lobe;
    material.highlight.normalisation = Normalisation::kExact;
  }
  return changed;
}

std::optional<LobeId> own_lobe(const Scene& scene) {
  std::optional<LobeId> own;
  for (const Material& material : scene.materials) {
    if (!has_highlight(material)) continue;
    if (own && *own != material.highlight.lobe) return std::nullopt;
    own = material.highlight.lobe;
  }
  return own;
}

std::vector<LobeId> lobe_candidates(const Scene& scene) {
  std::vector<LobeId> lobes(all_lobes().begin(), all_lobes().end());
  if (const auto own = own_lobe(scene);
      own && std::find(lobes.begin(), lobes.end(), *own) == lobes.end())
    lobes.push_back(*own);
  return lobes;
}

}  // namespace lobelia::cost
