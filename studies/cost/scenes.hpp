// Scenes that are measured, and changes to scenes.
#pragma once

#include <string_view>

#include "renderer/plan/plan.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::cost {

/// The scene with the longer side of its picture as given, in the same proportions.
Scene with_film(Scene scene, int side);

struct Without {
  Scene scene;
  Experiment experiment;  ///< changes that no scene can express
};
/// The scene without one effect of the plan's catalogue and nothing else changed: an area light becomes a point light
/// of the same power, surfaces keep their highlights. Throws Error(kInternal) for an unknown effect.
Without without(std::string_view effect, Scene scene);
/// The name of what replaces the effect: "pinhole".
std::string_view in_place_of(std::string_view effect);

/// Every effect of the catalogue is on: three spheres, a mirror among them, on a checker below a rectangle light and
/// a sky, seen through a lens.
Scene everything();

// Scenes lit by areas, which engines render with their own light transport.

/// A matt sphere on a matt plane, seen from above so that the plane fills the picture. No light yet.
Scene sphere_on_plane(int side);
/// The same below a rectangle light: a soft shadow.
Scene below_rectangle(int side);
/// The same below a sky with a small sun, an image of 1024 x 512.
Scene below_sky(int side);
/// With three bounces from surface to surface.
Scene with_inter_reflection(Scene scene);

}  // namespace lobelia::cost
