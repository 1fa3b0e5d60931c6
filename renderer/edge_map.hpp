// The pixels where rounding may decide what a ray hits.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// By pixel in reading order, 1 on a silhouette, a terminator (N.L = 0) or a shadow's edge: where one
/// of the eight neighbours sees another sphere, or is lit by other lights. Two programs that are both
/// right may differ there by the whole value of a pixel, and nowhere else. Throws Error(kInput) for a
/// scene in which a single ray does not tell.
std::vector<std::uint8_t> edge_map(const Scene& scene);

}  // namespace lobelia
