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

}  // namespace lobelia
