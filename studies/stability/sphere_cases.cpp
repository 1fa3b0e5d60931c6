#include <algorithm>
#include <cmath>

#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/render.hpp"
#include "studies/stability/cases.hpp"
#include "studies/stability/naive.hpp"
#include "studies/stability/sphere_scenes.hpp"

namespace lobelia::stability {
namespace {

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
  const double peak = truth::coefficient(highlight.model, highlight.lobe, highlight.exponent) *
                      framing.truth.peak();
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
