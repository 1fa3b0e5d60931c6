// Scenes for the tests of the reference engines, and how far two pictures are apart.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "core/image.hpp"
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

/// The lobes with the normalisations that the paper and the software compare.
struct Normalised {
  std::string_view lobe, normalisation;
};
inline constexpr Normalised kNormalisations[] = {
    {"cosine", "exact"}, {"cosine", "paper"}, {"cs16", "paper"}, {"cs16", "exact"}};

inline const Rgb kWhite{1, 1, 1};

/// Light from a direction `degrees` away from the viewer, off to the upper right.
inline Light directional_at(double degrees, Rgb irradiance = kWhite) {
  const double a = degrees * 3.14159265358979323846 / 180;
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

/// A second, smaller sphere that throws its shadow onto the first one's highlight; both coloured,
/// with a diffuse base, seen by a tilted camera in a picture that is not square.
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

/// A ball on a checker, in its own shadow; `mirrors` share the light with highlights that POV-Ray has itself.
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

/// Two balls and a floor that show one another.
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

/// Lights with a size, a lens, several rays a pixel: each alone, and all at once.
inline std::vector<NamedScene> soft_scenes(const HighlightChoice& choice, int size) {
  const Light sun = directional_at(50, {2, 1.5, 1});
  const Light ball = SphereLight{{2, 2.5, 2.5}, 0.6, {20, 16, 12}};
  const Light window = RectangleLight{{-2, 2, 2}, {0.5, 0, 0.5}, {0, -0.6, 0}, {9, 12, 15}};
  const Light sky = EnvironmentLight{{0.5, 0.7, 1}, {}, {}};
  std::vector<NamedScene> scenes = {{"a ball of light", ground_scene(choice, {ball}, size)},
                                    {"a window", ground_scene(choice, {window, sun}, size)},
                                    {"the sky", ground_scene(choice, {sky}, size)},
                                    {"several rays a pixel", ground_scene(choice, {sun}, size)},
                                    {"a lens", ground_scene(choice, {sun}, size)},
                                    {"all", ground_scene(choice, {ball, sun, window, sky}, size)}};
  for (const std::size_t i : {3, 5}) scenes[i].scene.sampler.sample_count = 16;
  scenes[3].scene.film.filter = *find_filter("mitchell");
  for (const std::size_t i : {4, 5}) {
    scenes[i].scene.camera.aperture_radius = 0.1;
    scenes[i].scene.camera.focus_distance = 4;
  }
  return scenes;
}

struct Difference {
  double of_peak = 0;  ///< greatest |a - b| over the peak of `truth`, without the outliers
  double relative =
      0;             ///< greatest |a - b| / truth where truth is above 1e-3 of the peak, likewise
  double worst = 0;  ///< of_peak with the outliers
  int outliers = 0;  ///< pixels over the tolerance
  bool finite = true;
};

/// A pixel is over the tolerance if a channel is: |a - truth| > relative * truth + of_peak * peak.
inline Difference difference(const Image& a, const Image& truth, double relative, double of_peak) {
  Difference d;
  if (a.width() != truth.width() || a.height() != truth.height()) {
    d.finite = false;
    return d;
  }
  const double peak = *std::max_element(truth.values().begin(), truth.values().end());
  for (int y = 0; y < truth.height(); ++y)
    for (int x = 0; x < truth.width(); ++x) {
      double over_peak = 0, over_value = 0;
      bool outlier = false;
      for (int c = 0; c < 3; ++c) {
        const double value = truth.pixel(x, y)[c], apart = std::abs(a.pixel(x, y)[c] - value);
        if (!std::isfinite(apart)) d.finite = false;
        over_peak = std::max(over_peak, apart / peak);
        if (value > 1e-3 * peak) over_value = std::max(over_value, apart / value);
        if (!(apart <= relative * value + of_peak * peak)) outlier = true;
      }
      d.worst = std::max(d.worst, over_peak);
      if (outlier) {
        ++d.outliers;
        continue;
      }
      d.of_peak = std::max(d.of_peak, over_peak);
      d.relative = std::max(d.relative, over_value);
    }
  return d;
}

}  // namespace lobelia
