// A scene with area lights, a lens or several rays per pixel as an average of scenes without them. Engines that agree with
// us pixel by pixel can render those, and their average must agree with the picture.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/pictures/image.hpp"
#include "renderer/scene/contact.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

class PreparedLight;
struct ReferenceResult;

/// Whether one ray through each pixel's centre under lights without size does not show the whole scene.
bool needs_replicates(const Scene& scene);

/// Delta lights, a pinhole, one ray per pixel.
struct SimpleScene {
  Scene scene;
  double weight = 1;  ///< in the mean; negative where the pixel's filter is
};

/// One estimate of the picture: the weighted mean of its scenes. Its expectation is the picture.
using Replicate = std::vector<SimpleScene>;

/// `count` independent estimates. Each spreads `points` points over every area light, the lens and the filter by Sobol's
/// sequence, scrambled anew (renderer/sobol.hpp). If only lights vary, one scene has all points as its lamps. The area
/// lights themselves, as the camera sees them, are missing: SizedLights adds them.
std::vector<Replicate> replicates(const Scene& scene, int count, int points, std::uint64_t seed);

/// A scene's area lights as the camera sees them, because engines' lamps are invisible.
class SizedLights {
 public:
  explicit SizedLights(const Scene& scene);
  ~SizedLights();

  /// In the view of one of the simple scenes: one ray through each pixel's centre, hidden by surfaces.
  Image seen_in(const Scene& simple) const;

 private:
  std::vector<Light> lights_;
  Contacts contacts_;
  std::vector<std::unique_ptr<const PreparedLight>> prepared_;
};

/// How an average of replicates differs from the truth. Counts are of values, three per pixel.
struct ReplicateStatistics {
  std::size_t values = 0;
  std::size_t random = 0;     ///< the difference is more than rounding
  std::size_t of_twenty = 0;  ///< of these, farther off than one in twenty is by chance
  /// Farther off than any value of the picture is by chance in one picture out of a thousand: Student's t with Sidak's
  /// correction for that many values.
  std::size_t beyond = 0;
  double rms = 0;  ///< of the difference, in radiance
};

/// `result` is an average of kReplicates estimates with `points` points in all. `rounding` is the relative error of the
/// engine's number format.
ReplicateStatistics replicate_statistics(const ReferenceResult& result, const Image& truth,
                                         int points, double rounding);

}  // namespace lobelia
