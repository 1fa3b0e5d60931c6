// The scenes that the benchmarks of light transport share.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/scene/scene.hpp"

namespace lobelia::bench {

/// A matt sphere that stands on a matt plane, seen from above so that the plane fills the picture. No
/// light yet.
Scene sphere_on_plane(int side);
/// The same below a rectangle of light: a soft shadow.
Scene below_rectangle(int side);
/// The same below a sky with a small sun, an image of 1024 x 512 that is written to `directory`.
Scene below_sky(int side, const std::filesystem::path& directory);

/// 10^decade spheres in a regular lattice that is jittered, all in the same cube: so small that a ray
/// through it meets as many on the average, whatever their number.
inline constexpr int kDecades = 6;
Scene crowd(int decade, int side);

}  // namespace lobelia::bench
