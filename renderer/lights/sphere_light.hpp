// A ball of light: directions drawn evenly from the cone that it fills (Shirley, Wang and Zimmerman 1996,
// section 3.2.1), which stays exact for a ball that is tiny or far because nothing in it cancels.
#pragma once

#include "renderer/lights/light_sample.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// u, v in [0, 1). Nothing from inside the ball: it shines outwards.
LightSample sample(const SphereLight& light, Vec3 point, double u, double v);
LightHit meet(const SphereLight& light, Vec3 point, Vec3 direction);

}  // namespace lobelia
