// Scenes lit by areas, which engines render with their own light transport.
#pragma once

#include "renderer/scene/scene.hpp"

namespace lobelia::cost {

/// A matt sphere on a matt plane, seen from above so that the plane fills the picture. No light yet.
Scene sphere_on_plane(int side);
/// The same below a rectangle light: a soft shadow.
Scene below_rectangle(int side);
/// The same below a sky with a small sun, an image of 1024 x 512.
Scene below_sky(int side);
/// With three bounces from surface to surface.
Scene with_inter_reflection(Scene scene);

}  // namespace lobelia::cost
