// A scene with another lobe in it: what is tried where accuracy is traded for time.
#pragma once

#include <optional>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia::accuracy {

/// Every highlight with that lobe, and the coefficient that makes its energy exact. A material that has the
/// lobe already stays as it is, coefficient included.
Scene with_lobe(const Scene& scene, LobeId lobe);
Highlight with_lobe(Highlight highlight, LobeId lobe);

/// The lobe of all highlights, or none where they differ or there is no highlight.
std::optional<LobeId> own_lobe(const Scene& scene);

/// The catalogue's; where they are not among them also the scene's own, and for each exponent n that is an even
/// number cs_n, which is cos^n without a logarithm.
std::vector<LobeId> lobe_candidates(const Scene& scene);

}  // namespace lobelia::accuracy
