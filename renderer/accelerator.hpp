// Finds the sphere that a ray meets among very many. Embree's bounding volume hierarchy narrows the search, and our
// test in double (renderer/chord.hpp) decides, so the answer is bit for bit that of a loop over all spheres.
#pragma once

#include <memory>
#include <span>

#include "renderer/scene/scene.hpp"

namespace lobelia {

class Accelerator {
 public:
  /// The spheres must outlive it. Builds with the threads of the caller's arena.
  explicit Accelerator(std::span<const Sphere> spheres);
  ~Accelerator();
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;

  struct Hit {
    int sphere = -1;  ///< -1: none
    double distance = 0;
  };
  /// The nearest sphere in front of `origin` except `leaves` (-1: none); of two at the same distance the one with the
  /// lower index. `direction` has unit length.
  Hit nearest(Vec3 origin, Vec3 direction, int leaves) const;
  /// Whether a sphere stands between the point and a light at `distance`, except `leaves` and those in `touched`,
  /// which the light lies on.
  bool blocked(Vec3 point, Vec3 to_light, double distance, int leaves,
               std::span<const int> touched = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lobelia
