// The scene whose highlight tests measure.
#pragma once

#include <string_view>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// One unit sphere lit from 45 degrees.
inline Scene scene_with(std::string_view model, double exponent) {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 28};
  scene.film = {160, 120};
  scene.lights.push_back(DirectionalLight{normalize({-1, 0, -1}), {2, 2, 2}});
  Material material;
  material.highlight.model = find_model(model).value();
  material.highlight.lobe = find_lobe("cosine").value();
  material.highlight.exponent = exponent;
  material.specular_reflectance = {0.5, 0.5, 0.5};
  scene.materials.push_back(material);
  scene.spheres.push_back({{0, 0, 0}, 1, 0});
  return scene;
}

}  // namespace lobelia
