#include "accuracy/lobe_candidates.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lobelia::accuracy {

Highlight with_lobe(Highlight highlight, LobeId lobe) {
  if (highlight.lobe == lobe) return highlight;
  highlight.lobe = lobe;
  highlight.normalisation = Normalisation::kExact;
  return highlight;
}

Scene with_lobe(const Scene& scene, LobeId lobe) {
  Scene changed = scene;
  for (Material& material : changed.materials)
    material.highlight = with_lobe(material.highlight, lobe);
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
  const auto add = [&](std::optional<LobeId> lobe) {
    if (lobe && std::find(lobes.begin(), lobes.end(), *lobe) == lobes.end()) lobes.push_back(*lobe);
  };
  add(own_lobe(scene));
  for (const Material& material : scene.materials)
    if (has_highlight(material))  // find_lobe knows which orders there are
      add(find_lobe(fmt::format("cs{}", material.highlight.exponent)));
  return lobes;
}

}  // namespace lobelia::accuracy
