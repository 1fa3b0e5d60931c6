// How bright a picture may get.
#pragma once

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Distance from a near lamp to the nearest surface that it can light; 1 if it can light none.
double nearest_surface(const Lamp& lamp, const Scene& scene);

/// Greatest radiance that the given lights can bring to the picture, straight or by mirrors, from above.
double peak_bound(const Scene& scene, const std::vector<Light>& lights);

}  // namespace lobelia
