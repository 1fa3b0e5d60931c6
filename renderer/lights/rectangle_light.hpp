// A rectangle of light: directions drawn evenly from the solid angle that it fills (Ureña, Fajardo and King
// 2013, "An area-preserving parametrization for spherical rectangles"); where that is too small for
// the angles of its corners to be told apart, points drawn evenly from its area.
#pragma once

#include "renderer/lights/light_sample.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// u, v in [0, 1). Nothing from behind: it shines to one side.
LightSample sample(const RectangleLight& light, Vec3 point, double u, double v);
LightHit meet(const RectangleLight& light, Vec3 point, Vec3 direction);

}  // namespace lobelia
