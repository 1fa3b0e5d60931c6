// A scene with another lobe in it: what is tried where accuracy is traded for time.
#pragma once

#include <optional>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia::cost {

/// Every highlight with that lobe, and the coefficient that makes its energy exact. A material that has the
/// lobe already stays as it is, coefficient included.
Scene with_lobe(const Scene& scene, LobeId lobe);

/// The lobe of all highlights, or none where they differ or there is no highlight.
std::optional<LobeId> own_lobe(const Scene& scene);

/// The catalogue's, and the scene's own where it is not among them.
std::vector<LobeId> lobe_candidates(const Scene& scene);

}  // namespace lobelia::cost
