// An upper bound of a picture's brightness.
#pragma once

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Distance from a near lamp to the nearest surface that it can light; 1 if there is none.
/// `closeness` is the scene's.
double nearest_surface(const Lamp& lamp, const Scene& scene, double closeness);

/// Upper bound of the radiance that the lights can bring to the picture, directly or by mirrors. `shadowing` is the largest
/// factor of a model's shadowing in it, where that is known; else it is the largest there is, at grazing angles.
double peak_bound(const Scene& scene, const std::vector<Light>& lights,
                  std::optional<double> shadowing = std::nullopt);

}  // namespace lobelia
