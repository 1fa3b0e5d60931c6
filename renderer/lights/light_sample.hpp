// A direction drawn towards a light with a size.
#pragma once

#include "core/vec.hpp"

namespace lobelia {

struct LightSample {
  Vec3 to_light;        ///< unit
  double distance = 0;  ///< to the light's surface; infinite for an environment
  double pdf = 0;       ///< per steradian; 0 where there is nothing to draw
  Rgb radiance;         ///< that arrives along it
};

/// What a ray from a point meets of a light.
struct LightHit {
  double distance = 0;
  double pdf =
      0;  ///< with which sampling would have drawn this direction; 0 where the light is missed
  Rgb radiance;
};

}  // namespace lobelia
