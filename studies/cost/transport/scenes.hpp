// Scenes whose light comes from areas, which engines show by their own light transport.
#pragma once

#include "renderer/scene/scene.hpp"

namespace lobelia::cost {

/// A matt sphere that stands on a matt plane, seen from above so that the plane fills the picture. No
/// light yet.
Scene sphere_on_plane(int side);
/// The same below a rectangle of light: a soft shadow.
Scene below_rectangle(int side);
/// The same below a sky with a small sun, an image of 1024 x 512.
Scene below_sky(int side);

/// Light goes so many times from surface to surface.
inline constexpr int kBounces = 3;
Scene with_inter_reflection(Scene scene);

}  // namespace lobelia::cost
