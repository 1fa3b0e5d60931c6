#include "studies/cost/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/words/constants.hpp"

namespace lobelia::cost {
namespace {

Material matt(const char* id, double reflectance) {
  Material m;
  m.id = id;
  m.highlight.exponent = 1;
  m.specular_reflectance = {};
  m.diffuse_reflectance = {reflectance, reflectance, reflectance};
  return m;
}

/// Blue, brighter towards the horizon, with a white sun of 2 degrees and 160 times the sky's light in a
/// soft edge; black below the horizon, where a finite plane would let light through.
Image sky() {
  constexpr int kWidth = 1024, kHeight = 512;
  const Vec3 sun = normalize({0.5, 0.8, 0.45});
  Image image(kWidth, kHeight);
  for (int y = 0; y < kHeight / 2; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double down = kPi * (y + 0.5) / kHeight;
      const double turn = 2 * kPi * ((x + 0.5) / kWidth - 0.5);
      const Vec3 d{std::sin(down) * std::sin(turn), std::cos(down),
                   -std::sin(down) * std::cos(turn)};
      const double haze = 1 - std::cos(down), angle = std::acos(std::min(1.0, dot(d, sun)));
      const double disc = 800 / (1 + std::exp((angle - 0.0175) / 0.002));
      auto pixel = image.pixel(x, y);
      pixel[0] = float(0.2 + 0.5 * haze + disc);
      pixel[1] = float(0.35 + 0.4 * haze + disc);
      pixel[2] = float(0.7 + 0.2 * haze + 0.8 * disc);
    }
  return image;
}

}  // namespace

Scene sphere_on_plane(int side) {
  Scene scene;
  scene.camera = {{0.6, 3.4, 5.2}, {0.1, -0.4, 0}, {0, 1, 0}, 32};
  scene.film = {side, side};
  scene.materials = {matt("ball", 0.8), matt("floor", 0.5)};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  scene.planes = {{{0, -1, 0}, {0, 1, 0}, 1, 1}};
  return scene;
}

Scene below_rectangle(int side) {
  Scene scene = sphere_on_plane(side);
  scene.lights = {RectangleLight{{1.2, 3.2, 0.8}, {0.9, 0, 0}, {0, 0, 0.6}, {6, 6, 6}}};
  return scene;
}

Scene below_sky(int side) {
  Scene scene = sphere_on_plane(side);
  scene.lights = {EnvmapLight{{1, 1, 1}, std::make_shared<Image>(sky()), "sky.exr"}};
  return scene;
}

Scene with_inter_reflection(Scene scene) {
  scene.depth.glossy = 3;
  return scene;
}

}  // namespace lobelia::cost
