// Scenes with hard geometry: extreme sizes, distances and positions.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia::stability {

struct HardScene {
  std::string name;
  Scene scene;  ///< without highlights
};
std::vector<HardScene> hard_scenes();

/// The scene from so close that a highlight of that exponent fills the picture; nothing if the first light makes no
/// highlight on the first sphere.
std::vector<Scene> close_to_highlight(Scene scene, double exponent);

}  // namespace lobelia::stability
