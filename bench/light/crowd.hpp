// Scenes to see by how time grows with the number of spheres.
#pragma once

#include "renderer/scene/scene.hpp"

namespace lobelia::bench {

/// 10^decade spheres in a regular lattice that is jittered, all in the same cube: so small that a ray
/// through it meets as many on the average, whatever their number.
inline constexpr int kDecades = 6;
Scene crowd(int decade, int side);

}  // namespace lobelia::bench
