// A scene with lights of some size, a lens or several rays a pixel as an average of scenes that have none:
// what engines that agree with us pixel by pixel can render, and what their average must agree with.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Whether a single ray through each pixel's centre under lamps without a size does not tell it all.
bool needs_replicates(const Scene& scene);

/// Delta lights, a pinhole, one ray a pixel; it counts `weight` times.
struct SimpleScene {
  Scene scene;
  double weight = 1;  ///< negative where the pixel's filter is
};

/// One estimate of the picture: the weighted mean of its scenes. Its expectation is the picture.
using Replicate = std::vector<SimpleScene>;

/// `count` independent estimates. In each, `points` points are spread over every light, the lens and the
/// filter by Sobol's sequence, scrambled for each replicate anew (renderer/sobol.hpp). Where only lights
/// vary, one scene has all points as its lamps. The lights themselves, as the camera sees them, are not in
/// it: see emitted().
std::vector<Replicate> replicates(const Scene& scene, int count, int points, std::uint64_t seed);

/// What the camera sees of lights with a size in the scene's view, one ray through each pixel's centre,
/// behind no surface: engines' lamps cannot be seen. `simple` says from where, `scene` which lights.
Image emitted(const Scene& scene, const Scene& simple);

}  // namespace lobelia
