#include "bench/light/crowd.hpp"

#include <cmath>
#include <numbers>

#include "renderer/scene/sphere_lattice.hpp"

namespace lobelia::bench {

Scene crowd(int decade, int side) {
  // Columns, rows and layers, as near a cube as two and five make it.
  constexpr int kLattices[kDecades + 1][3] = {
      {1, 1, 1}, {5, 2, 1}, {5, 5, 4}, {10, 10, 10}, {25, 20, 20}, {50, 50, 40}, {100, 100, 100}};
  constexpr double kSide = 2, kMeanHits = 0.5;
  const auto& n = kLattices[decade];
  const double count = double(n[0]) * n[1] * n[2];
  SphereLattice lattice;
  lattice.columns = n[0], lattice.rows = n[1], lattice.layers = n[2];
  lattice.step = {kSide / n[0], kSide / n[1], kSide / n[2]};
  lattice.radius = kSide * std::sqrt(kMeanHits / (std::numbers::pi * count));
  lattice.jitter = 1;
  lattice.seed = 1;
  Scene scene;
  scene.camera = {{4, 3, 10}, {0, 0, 0}, {0, 1, 0}, 13};
  scene.film = {side, side};
  scene.materials = {{}};
  scene.materials[0].id = "ball";
  scene.materials[0].highlight.exponent = 1;
  scene.materials[0].diffuse_reflectance = {0.6, 0.6, 0.6};
  scene.lights = {DirectionalLight{normalize({-0.3, -0.8, -0.6}), {3, 3, 3}}};
  lattice.append_to(scene.spheres);
  return scene;
}

}  // namespace lobelia::bench
