// Scenes for comparisons: every effect that engines share, alone, in small pictures.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia {

struct HighlightChoice {
  std::string_view model, lobe, normalisation;
  double exponent;
};

inline Highlight highlight_of(const HighlightChoice& choice) {
  return {*find_model(choice.model), *find_lobe(choice.lobe),
          *find_normalisation(choice.normalisation), choice.exponent};
}

inline const Rgb kWhite{1, 1, 1};

/// Light from a direction `degrees` away from the viewer, off to the upper right.
inline Light directional_at(double degrees, Rgb irradiance = kWhite) {
  const double a = degrees * std::numbers::pi / 180;
  return DirectionalLight{{-0.8 * std::sin(a), -0.6 * std::sin(a), -std::cos(a)}, irradiance};
}
inline Light point_light(Rgb intensity = 10 * kWhite) { return PointLight{{2, 1.5, 3}, intensity}; }

/// A unit sphere in the middle of the picture.
inline Scene sphere_scene(const HighlightChoice& choice, std::vector<Light> lights, int size) {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 28.07};
  scene.film = {size, size};
  scene.lights = std::move(lights);
  scene.materials = {{"material", highlight_of(choice), kWhite, {0, 0, 0}}};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  return scene;
}

/// A second, smaller sphere casts its shadow onto the first one's highlight; both coloured, with a diffuse base, seen by
/// a tilted camera in a picture that is not square.
inline Scene shadow_scene(const HighlightChoice& choice, std::vector<Light> lights, int size) {
  Scene scene = sphere_scene(choice, std::move(lights), size);
  scene.camera = {{1.5, -0.7, 4.5}, {0.2, 0.1, 0}, {0.3, 1, 0.1}, 34};
  scene.film.height = size * 3 / 4;
  scene.materials[0].specular_reflectance = {0.9, 0.6, 0.3};
  scene.materials[0].diffuse_reflectance = {0.1, 0.2, 0.4};
  scene.materials.push_back(
      {"other", highlight_of({"modified_phong", "cosine", "exact", 40}), {0.5, 0.5, 0.5}, {}});
  scene.spheres.push_back({{0.62, 0.45, 1.15}, 0.25, 1});
  return scene;
}

/// A ball on a checker, in its own shadow.
inline Scene ground_scene(const HighlightChoice& choice, std::vector<Light> lights, int size) {
  Scene scene = sphere_scene(choice, std::move(lights), size);
  scene.camera = {{0.3, 1.6, 5.2}, {0, -0.1, 0}, {0, 1, 0}, 36};
  scene.film.height = size * 3 / 4;
  scene.materials[0].specular_reflectance = {0.5, 0.4, 0.6};
  scene.materials[0].diffuse_reflectance = {0.3, 0.2, 0.1};
  scene.materials.push_back({"light", highlight_of(choice), {0.4, 0.4, 0.4}, {0.7, 0.6, 0.5}});
  scene.materials.push_back(
      {"dark", highlight_of({"phong_rdf", "cosine", "exact", 20}), {}, {0.1, 0.1, 0.2}});
  scene.planes = {{{0, -1, 0}, {0, 1, 0}, 1, 2, 0.75}, {{0, 0, -4}, {0, 0, 1}, 1, 1, 1}};
  return scene;
}

/// Two balls and a floor that reflect one another.
inline Scene mirror_scene(const HighlightChoice& choice, std::vector<Light> lights, int size) {
  Scene scene = ground_scene(choice, std::move(lights), size);
  for (Material& material : scene.materials)
    material.specular_reflectance = material.specular_reflectance.r * kWhite;
  scene.materials[0].mirror_reflectance = {0.6, 0.5, 0.4};
  scene.materials[1].mirror_reflectance = {0.3, 0.3, 0.3};
  scene.spheres.push_back({{1.6, -0.5, 0.8}, 0.5, 0});
  scene.depth.mirror = 3;
  return scene;
}

struct NamedScene {
  std::string name;
  Scene scene;
};

/// Area lights, a lens, several rays a pixel: each alone, and all at once.
inline std::vector<NamedScene> soft_scenes(const HighlightChoice& choice, int size) {
  const Light sun = directional_at(50, {2, 1.5, 1});
  const Light ball = SphereLight{{2, 2.5, 2.5}, 0.6, {20, 16, 12}};
  const Light window = RectangleLight{{-2, 2, 2}, {0.5, 0, 0.5}, {0, -0.6, 0}, {9, 12, 15}};
  const Light sky = ConstantLight{{0.5, 0.7, 1}};
  std::vector<NamedScene> scenes = {
      {"sphere light", ground_scene(choice, {ball}, size)},
      {"rectangle light and sun", ground_scene(choice, {window, sun}, size)},
      {"environment", ground_scene(choice, {sky}, size)},
      {"antialiasing", ground_scene(choice, {sun}, size)},
      {"lens", ground_scene(choice, {sun}, size)},
      {"all at once", ground_scene(choice, {ball, sun, window, sky}, size)}};
  for (const std::size_t i : {3, 5}) scenes[i].scene.sampler.sample_count = 16;
  scenes[3].scene.film.filter = *find_filter("mitchell");
  for (const std::size_t i : {4, 5}) {
    scenes[i].scene.camera.aperture_radius = 0.1;
    scenes[i].scene.camera.focus_distance = 4;
  }
  return scenes;
}

}  // namespace lobelia
