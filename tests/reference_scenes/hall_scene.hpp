// A scene with everything that formulas per pixel know, for the tests of who evaluates them.
#pragma once

#include "tests/reference_scenes/test_scenes.hpp"

namespace lobelia {

/// Two mirroring spheres, one of them coloured by Schlick's factor, and a small one on a checkered mirror of a
/// floor before an oblique checkered wall, by four lamps of other colours and kinds; the film aside. `choice` is
/// the first and third sphere's highlight.
inline Scene hall_scene(const HighlightChoice& choice, int size) {
  Scene scene;
  scene.camera = {{0.4, 1.6, 6}, {0, 0.6, 0}, {0.1, 1, 0}, 44};
  scene.camera.principal_point_offset_x = 0.04;
  scene.camera.principal_point_offset_y = -0.03;
  scene.film = {size, size * 3 / 4};
  scene.depth.mirror = 4;
  const Highlight wide = highlight_of({"modified_phong", "cosine", "exact", 20});
  scene.materials = {
      {"glossy", highlight_of(choice), {0.6, 0.4, 0.05}, {0.2, 0.1, 0.3}},
      {"dark", wide, {0.1, 0.1, 0.1}, {0.05, 0.05, 0.1}},
      {"light", wide, {}, {0.7, 0.6, 0.5}},
      {"chrome", highlight_of(choice), {0.5, 0.5, 0.5}, {}},
  };
  scene.materials[0].fresnel = Fresnel::kSchlick;
  scene.materials[0].mirror_reflectance = {0.1, 0.2, 0.3};
  scene.materials[1].mirror_reflectance = {0.2, 0.2, 0.2};
  scene.materials[3].mirror_reflectance = {0.9, 0.8, 0.7};
  scene.spheres = {{{-0.9, 0.8, 0}, 0.8, 0}, {{1, 0.7, -0.5}, 0.7, 3}, {{0.2, 0.3, 1.2}, 0.3, 0}};
  scene.planes = {{{0.1, 0, 0.2}, {0, 1, 0}, 1, 2, 0.7},
                  {{0, 0, -4}, normalize({0.2, -0.1, 1}), 2, 1, 1.3}};
  scene.lights = {
      DirectionalLight{normalize({-0.3, -0.6, -1}), {1, 0.8, 0.6}},
      PointLight{{2, 4, 3}, {6, 9, 12}},
      PointLight{{-2.5, 3.5, 1.5}, {8, 4, 4}, normalize({0.5, -1, -0.3})},
      PointLight{{0.3, -2, 4}, {50, 50, 50}},  // beneath the floor: hidden everywhere
  };
  return scene;
}

}  // namespace lobelia
