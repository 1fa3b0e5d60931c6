// Scenes of one surface, of which much is known without a renderer.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>

#include "renderer/render.hpp"

namespace lobelia {

inline Material matt(double albedo) {
  Material m;
  m.highlight = {*find_model("phong_rdf"), *find_lobe("cosine"), {}, 32};
  m.specular_reflectance = {};
  m.diffuse_reflectance = {albedo, albedo, albedo};
  return m;
}
inline Material shiny(double exponent) {
  Material m = matt(0.2);
  m.highlight.exponent = exponent;
  m.specular_reflectance = {0.5, 0.5, 0.5};
  return m;
}

/// A unit sphere that fills the picture, so that every pixel sees it.
inline Scene one_sphere(const Material& material) {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 10};
  scene.film = {16, 16};
  scene.materials = {material};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  return scene;
}

/// A horizontal plane seen straight from above, its origin in the middle of the picture.
inline Scene one_plane(const Material& material) {
  Scene scene;
  scene.camera = {{0, 10, 0}, {0, 0, 0}, {0, 0, -1}, 1};
  scene.film = {4, 4};
  scene.materials = {material};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}}};
  return scene;
}

/// Two spheres on a checkered ground.
inline Scene on_the_ground() {
  Scene scene;
  scene.camera = {{0, 2, 6}, {0, 0.8, 0}, {0, 1, 0}, 40};
  scene.film = {48, 36};
  scene.lights = {DirectionalLight{normalize({-1, -2, -1}), {2, 2, 2}}};
  scene.materials = {shiny(64), matt(0.6), matt(0.1)};
  scene.spheres = {{{-1, 1, 0}, 1, 0}, {{1.2, 0.7, 0.5}, 0.7, 0}};
  scene.planes = {{{0, 0, 0}, {0, 1, 0}, 1, 2, 0.5}};
  return scene;
}

inline double mean(const Image& image) {
  double sum = 0;
  for (const float v : image.values()) sum += v;
  return sum / double(image.values().size());
}

inline bool same(const Image& a, const Image& b) {
  return std::equal(a.values().begin(), a.values().end(), b.values().begin(), b.values().end());
}

inline RenderResult with_all(const Scene& scene) {
  RenderOptions options;
  options.effects = EffectPolicy::kAll;
  return render(scene, options);
}

inline std::shared_ptr<const Image> sky(const std::function<float(int, int)>& value) {
  auto image = std::make_shared<Image>(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      for (float& c : image->pixel(x, y)) c = value(x, y);
  return image;
}

}  // namespace lobelia
