// A scene that calls for every effect of the plan's catalogue.
#pragma once

#include "renderer/scene/scene.hpp"

namespace lobelia::cost {

/// Three spheres, a mirror among them, on a checker below a rectangle of light and a sky, seen through a lens.
Scene everything();

}  // namespace lobelia::cost
