// A scene with lights of some size, a lens or several rays a pixel as an average of scenes that have none:
// what engines that agree with us pixel by pixel can render, and what their average must agree with.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/image.hpp"
#include "renderer/scene/contact.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

class PreparedLight;

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
/// it: see SizedLights.
std::vector<Replicate> replicates(const Scene& scene, int count, int points, std::uint64_t seed);

/// The lights of a scene that have a size, as its camera sees them: engines' lamps cannot be seen.
class SizedLights {
 public:
  explicit SizedLights(const Scene& scene);
  ~SizedLights();

  /// In the view of one of the scene's simple ones, one ray through each pixel's centre, behind no surface.
  Image seen_in(const Scene& simple) const;

 private:
  std::vector<Light> lights_;
  Contacts contacts_;
  std::vector<std::unique_ptr<const PreparedLight>> prepared_;
};

}  // namespace lobelia
