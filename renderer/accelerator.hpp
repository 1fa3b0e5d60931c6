// Which of very many spheres a ray meets: Embree's bounding volume hierarchy over them, and our own test of
// ray and sphere in double (renderer/chord.hpp), so that the answer is that of a loop of it over all, bit for
// bit.
#pragma once

#include <memory>
#include <span>

#include "renderer/scene/scene.hpp"

namespace lobelia {

class Accelerator {
 public:
  /// Refers to the spheres, and builds with the threads of the caller's arena.
  explicit Accelerator(std::span<const Sphere> spheres);
  ~Accelerator();
  Accelerator(const Accelerator&) = delete;
  Accelerator& operator=(const Accelerator&) = delete;

  struct Hit {
    int sphere = -1;  ///< -1: none
    double distance = 0;
  };
  /// The nearest sphere in front of `origin` but for `leaves` (-1: none); of two at the same distance
  /// the one with the lower index. `direction` is of unit length.
  Hit nearest(Vec3 origin, Vec3 direction, int leaves) const;
  /// Whether one but for `leaves` and those that the light lies on stands between the point and what is
  /// at `distance`.
  bool blocked(Vec3 point, Vec3 to_light, double distance, int leaves,
               std::span<const int> touched = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lobelia
