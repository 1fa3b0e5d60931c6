#include "studies/stability/cases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/render.hpp"
#include "studies/stability/naive.hpp"

namespace lobelia::stability {
namespace {

constexpr int kFilmSide = 33;  ///< odd, so that one ray runs along the axis

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

const Vec3 kOblique = normalize({-1, -2, -3});  ///< where the light travels

/// A sphere that fills the picture but for a seventh, seen from `from` radii away in a direction.
HardScene one_sphere(std::string name, double radius, Vec3 center, double from, Vec3 direction) {
  Scene scene;
  scene.camera.origin = center + from * radius * normalize(direction);
  scene.camera.target = center;
  scene.camera.up = {0, 1, 0};
  scene.camera.fov_degrees = 2 * degrees(std::atan(1.15 / from));
  scene.film = {kFilmSide, kFilmSide};
  scene.lights = {DirectionalLight{kOblique, {1, 1, 1}}};
  scene.materials = {{"", {}, {1, 1, 1}, {}, Fresnel::kNone}};
  scene.spheres = {{center, radius, 0}};
  return {std::move(name), std::move(scene)};
}

HardScene with_sphere(HardScene hard, std::string name, Sphere sphere) {
  hard.name = std::move(name);
  hard.scene.spheres.push_back(sphere);
  return hard;
}

HardScene with_light(HardScene hard, std::string name, Light light) {
  hard.name = std::move(name);
  hard.scene.lights = {light};
  return hard;
}

constexpr double kSphereExponents[] = {16, 1e4, 1e6};

struct Framing {
  std::string name;
  double exponent;  ///< 0 for all
  Scene scene;
  truth::Picture truth;
  int wrong_pixels;  ///< in ours
};

/// Counts the pixels of a real rendering that show the wrong sphere: each has its own diffuse colour, lit from the eye.
int wrong_hits(Scene scene, const truth::Picture& truth) {
  constexpr Rgb kColours[] = {{1, 0, 0}, {0, 1, 0}};
  const Vec3 to_eye = scene.camera.origin - scene.spheres[0].center;
  const double bright = dot(to_eye, to_eye) + scene.spheres[0].radius * scene.spheres[0].radius;
  scene.lights = {PointLight{scene.camera.origin, {bright, bright, bright}}};
  scene.materials.assign(scene.spheres.size(), scene.materials[0]);
  for (std::size_t k = 0; k < scene.spheres.size(); ++k) {
    scene.spheres[k].material = int(k);
    scene.materials[k].specular_reflectance = {};
    scene.materials[k].diffuse_reflectance = kColours[k];
  }
  const Image image = render(scene, {}).image;
  int wrong = 0;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const float* p = image.values().data() + 3 * i;
    const int seen = p[0] > 0 ? 0 : p[1] > 0 ? 1 : -1;
    if (seen != truth.sphere(i)) ++wrong;
  }
  return wrong;
}

/// Made once for all lobes.
const std::vector<Framing>& framings() {
  static const std::vector<Framing> all = [] {
    std::vector<Framing> made;
    const auto add = [&](const std::string& name, double exponent, const Scene& scene) {
      truth::Picture truth(scene);
      const int wrong = wrong_hits(scene, truth);
      made.push_back({name, exponent, scene, std::move(truth), wrong});
    };
    for (const HardScene& hard : hard_scenes()) {
      add(hard.name, 0, hard.scene);
      for (const double n : kSphereExponents)
        for (const Scene& close : close_to_highlight(hard.scene, n))
          add(hard.name + ", close", n, close);
    }
    return made;
  }();
  return all;
}

/// The worst pixel of a picture. Units in the last place are counted above a thousandth of the peak; farther down the
/// flank they do not matter in a picture.
struct WorstPixel {
  Answer answer = {};
  double truth = 0;
  void note(double value, double true_value, double peak) {
    const Answer here = judge(value, true_value, peak > 0 ? peak : 1);
    if (!std::isfinite(value)) ++answer.wrong_pixels;
    if (true_value > 1e-3 * peak) answer.ulp = std::max(answer.ulp, here.ulp);
    if (here.of_peak < answer.of_peak) return;
    answer.of_peak = here.of_peak;
    answer.value = value;
    truth = true_value;
  }
};

Row compare_pictures(const Framing& framing, const Highlight& highlight) {
  Scene scene = framing.scene;
  for (Material& material : scene.materials) material.highlight = highlight;
  const Image image = render(scene, {}).image;
  const auto naive = naive::picture(scene);
  const auto truth = framing.truth.highlights(highlight);
  double peak = truth::coefficient(highlight.model, highlight.lobe, highlight.exponent) *
                framing.truth.peak();
  // With shadowing the highlight is higher at grazing angles.
  for (const Rgb& pixel : truth) peak = std::max(peak, max_component(pixel));
  WorstPixel of_ours, of_naive;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    of_ours.note(image.values()[3 * i], truth[i].r, peak);
    of_naive.note(naive[i].radiance.r, truth[i].r, peak);
    if (naive[i].sphere != framing.truth.sphere(i)) ++of_naive.answer.wrong_pixels;
  }
  of_ours.answer.wrong_pixels += framing.wrong_pixels;
  return judged("spheres", framing.name, Subject(highlight), of_ours.truth, of_naive.answer,
                of_ours.answer, kAllowedShadingError);
}

}  // namespace

std::vector<HardScene> hard_scenes() {
  const Vec3 axis{0, 0, 1}, oblique{1, 0.4, 2};
  const HardScene plain = one_sphere("radius 1", 1, {}, 5, axis);
  std::vector<HardScene> scenes{
      plain,
      one_sphere("radius 1e-6", 1e-6, {}, 5, oblique),
      one_sphere("radius 1e-6, away from the origin", 1e-6, {0.3, -0.2, 0.7}, 5, oblique),
      one_sphere("radius 1e6", 1e6, {}, 5, oblique),
      one_sphere("radius 1e6, from just above", 1e6, {}, 1.01, oblique),
      one_sphere("1e7 radii away", 1, {}, 1e7, axis),
      one_sphere("1e7 radii away, oblique", 1, {}, 1e7, oblique),
      one_sphere("1e7 radii of 1e-6 away", 1e-6, {}, 1e7, oblique),
      with_sphere(plain, "two concentric spheres", {{}, 0.5, 0}),
      with_sphere(plain, "two concentric spheres, an ulp apart", {{}, std::nextafter(1, 0), 0}),
      with_sphere(plain, "the same sphere twice", plain.scene.spheres[0]),
      with_sphere(plain, "two spheres that touch", {{0, 2, 0}, 1, 0}),
      with_light(plain, "light inside the sphere", PointLight{{0.1, 0.2, 0.3}, {1, 1, 1}}),
      with_sphere(with_light(plain, "", PointLight{{0.1, 0.2, 0.3}, {1, 1, 1}}),
                  "light inside one of two spheres", {{-0.9, 0.8, 1}, 0.2, 0}),
      with_light(plain, "light just above the surface", PointLight{{0, 0.6, 0.801}, {1, 1, 1}}),
      with_light(plain, "light at a right angle", DirectionalLight{{1, 0, 0}, {1, 1, 1}}),
      with_light(plain, "light behind the sphere, all but",
                 DirectionalLight{normalize({0, 1e-3, 1}), {1, 1, 1}}),
  };
  HardScene inside = plain;
  inside.name = "camera inside";
  inside.scene.spheres[0].radius = 10;
  scenes.push_back(inside);
  // The middle ray runs along the tangent: an ulp of the radius decides.
  for (const auto& [name, radius] :
       {std::pair("tangent ray", 1.0),
        std::pair("tangent ray, an ulp inside", std::nextafter(1, 2)),
        std::pair("tangent ray, an ulp outside", std::nextafter(1, 0))}) {
    HardScene tangent = plain;
    tangent.name = name;
    tangent.scene.spheres[0] = {{1, 0, 0}, radius, 0};
    scenes.push_back(tangent);
  }
  return scenes;
}

std::vector<Scene> close_to_highlight(Scene scene, double exponent) {
  const Sphere& sphere = scene.spheres[0];
  Vec3 normal = normalize(scene.camera.origin - sphere.center), point;
  // The distance over which the direction to the eye or the light, or the normal, changes.
  double scale = sphere.radius;
  // In small steps: just above the surface the direction changes much from point to point.
  for (int i = 0; i < 20000; ++i) {
    point = sphere.center + sphere.radius * normal;
    const Illumination light = illuminate(scene.lights[0], point);
    const Vec3 to_eye = scene.camera.origin - point;
    scale = std::min({sphere.radius, light.distance, length(to_eye)});
    const Vec3 half = normalize(light.to_light + normalize(to_eye));
    normal = normalize(normal + 0.5 * scale / sphere.radius * (half - normal));
  }
  const double distance = length(scene.camera.origin - point);
  const auto hit =
      nearest_hit(scene, scene.camera.origin, 1 / distance * (point - scene.camera.origin));
  const Vec3 to_light = illuminate(scene.lights[0], point).to_light;
  if (!hit || hit->sphere != 0 || !(dot(hit->normal, to_light) > 0.05)) return {};
  scene.camera.target = point;
  scene.camera.fov_degrees =
      2 * degrees(std::atan(std::min(1.0, 2.5 / std::sqrt(exponent)) * scale / distance));
  scene.film = {kFilmSide - 8, kFilmSide - 8};
  return {scene};
}

Rows sphere_rows(LobeId lobe) {
  Rows rows;
  for (const Framing& framing : framings())
    for (const ModelId model : all_models())
      for (const double n : kSphereExponents)
        if (framing.exponent == 0 || framing.exponent == n)
          rows.push_back(compare_pictures(framing, {model, lobe, Normalisation::kExact, n}));
  return rows;
}

}  // namespace lobelia::stability
