#include "studies/cost/scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/constants.hpp"
#include "core/error.hpp"
#include "renderer/plan/effects/catalogue.hpp"

namespace lobelia::cost {
namespace {

struct Removal {
  std::string_view effect, replacement;
  void (*apply)(Scene&, Experiment&);
};

Removal removal_of(std::string_view effect) {
  static constexpr auto kRemovals = map_types<Removal>(Effects{}, []<class E>() {
    return Removal{E::kName, E::kWithout, &E::leave_out};
  });
  const auto* const found = std::ranges::find(kRemovals, effect, &Removal::effect);
  if (found == kRemovals.end())
    throw Error(ExitCode::kInternal, fmt::format("there is no effect {}", effect));
  return *found;
}

Material material(const char* id, double exponent, Rgb specular, Rgb diffuse) {
  Material m;
  m.id = id;
  m.highlight.exponent = exponent;
  m.specular_reflectance = specular;
  m.diffuse_reflectance = diffuse;
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

Scene with_film(Scene scene, int side) {
  Film& film = scene.film;
  const double scale = double(side) / std::max(film.width, film.height);
  film.width = std::max(1, int(scale * film.width + 0.5));
  film.height = std::max(1, int(scale * film.height + 0.5));
  return scene;
}

Without without(std::string_view effect, Scene scene) {
  Without result{std::move(scene), {}};
  removal_of(effect).apply(result.scene, result.experiment);
  return result;
}

std::string_view in_place_of(std::string_view effect) { return removal_of(effect).replacement; }

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

Scene sphere_on_plane(int side) {
  Scene scene;
  scene.camera = {{0.6, 3.4, 5.2}, {0.1, -0.4, 0}, {0, 1, 0}, 32};
  scene.film = {side, side};
  scene.materials = {material("ball", 1, {}, {0.8, 0.8, 0.8}),
                     material("floor", 1, {}, {0.5, 0.5, 0.5})};
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
