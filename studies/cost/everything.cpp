#include "studies/cost/everything.hpp"

namespace lobelia::cost {
namespace {

Material material(const char* id, double exponent, Rgb specular, Rgb diffuse) {
  Material m;
  m.id = id;
  m.highlight.exponent = exponent;
  m.specular_reflectance = specular;
  m.diffuse_reflectance = diffuse;
  return m;
}

}  // namespace

Scene everything() {
  Scene scene;
  scene.camera = {{0, 1.6, 5.2}, {0, -0.3, 0}, {0, 1, 0}, 36};
  scene.camera.aperture_radius = 0.08;
  scene.camera.focus_distance = 5;
  scene.film = {256, 256};
  scene.sampler = {64, 0};
  scene.depth = {3, 2};
  scene.lights = {RectangleLight{{1, 3.2, 1.4}, {0.9, 0, 0}, {0, 0, 0.5}, {5, 5, 5}},
                  ConstantLight{{0.12, 0.15, 0.2}}};
  scene.materials = {material("varnish", 96, {0.04, 0.04, 0.04}, {0.6, 0.15, 0.1}),
                     material("mirror", 256, {0.2, 0.2, 0.2}, {}),
                     material("metal", 48, {0.5, 0.4, 0.2}, {0.1, 0.08, 0.04}),
                     material("light_square", 1, {}, {0.7, 0.68, 0.64}),
                     material("dark_square", 1, {}, {0.12, 0.12, 0.14})};
  scene.materials[0].fresnel = Fresnel::kSchlick;
  scene.materials[1].mirror_reflectance = {0.8, 0.8, 0.8};
  scene.spheres = {
      {{-1.1, -0.3, 0.4}, 0.7, 0}, {{0.5, -0.2, -0.6}, 0.8, 1}, {{0.9, -0.6, 1}, 0.4, 2}};
  scene.planes = {{{0, -1, 0}, {0, 1, 0}, 3, 4, 0.75}};
  return scene;
}

}  // namespace lobelia::cost
