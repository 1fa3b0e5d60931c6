// Scenes that are hard on the geometry: how large, how far, from where.
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

/// The same seen so closely that a highlight of that exponent fills the picture, or nothing where the
/// first light makes no highlight on the first sphere.
std::vector<Scene> close_to_highlight(Scene scene, double exponent);

}  // namespace lobelia::stability
