#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <numbers>

#include "base/system/error.hpp"
#include "reference_scenes/engines/analytic/formulas/big.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "reference_scenes/engines/analytic/formulas/tracer.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/pixel_ray.hpp"

namespace lobelia::truth {
namespace {

/// F0 + (F90 - F0) (1 - cosine)^5 where the material asks for it, else F0.
template <class Real>
Rgb reflected(Fresnel fresnel, Rgb f0, double f90, const Real& cosine) {
  if (fresnel == Fresnel::kNone) return f0;
  const Real rest = 1 - cosine;
  const double weight(rest * rest * rest * rest * rest);
  return f0 + weight * Rgb{f90 - f0.r, f90 - f0.g, f90 - f0.b};
}

/// A mirror's F90: 50 times its largest component, until that is 1.
double mirror_f90(Rgb f0) { return std::min(50 * std::max({f0.r, f0.g, f0.b}), 1.0); }

/// A material, and what is the same for it in every pixel.
struct Finish {
  const Material& material;
  const ModelRow& model;
  double coefficient = 0;  ///< 0 without a highlight

  explicit Finish(const Material& m) : material(m), model(model_row(m.highlight.model)) {
    if (has_highlight(m)) coefficient = truth::coefficient(m.highlight);
  }
  /// Radiance per irradiance normal to the beam.
  template <class Real>
  Rgb reflectance(const Met<Real>& at, const Arrival<Real>& light) const {
    const double n_dot_l(light.n_dot_l);
    const Rgb diffuse = n_dot_l * std::numbers::inv_pi * material.diffuse_reflectance;
    if (coefficient == 0) return diffuse;
    const Highlight& highlight = material.highlight;
    const Real cosine = lobe_cosine(model.angle, at.normal, at.to_eye, light.to_light);
    const double lobe(lobe_of_cosine(highlight.lobe, cosine, highlight.exponent));
    const Real v_dot_h = dot(at.to_eye, normalize(light.to_light + at.to_eye));
    const double geometry(
        truth::geometry<Real>(model, highlight.exponent, light.n_dot_l, dot(at.normal, at.to_eye)));
    return coefficient * lobe * geometry *
               reflected(material.fresnel, material.specular_reflectance, 1, v_dot_h) +
           diffuse;
  }
};

/// `reflectance(met, arrival)` is the radiance per irradiance normal to the beam, without mirrors.
template <class Real, class Reflectance>
std::vector<Rgb> trace(const Scene& scene, const std::function<bool()>& stop,
                       const Reflectance& reflectance) {
  if (const std::string why = why_not_evaluated(scene); !why.empty())
    throw Error(ExitCode::kInput, why);
  const Tracer<Real> tracer(scene);
  const int width = scene.film.width;
  std::vector<Rgb> picture(std::size_t(width) * scene.film.height);
  oneapi::tbb::parallel_for(0, scene.film.height, [&](int y) {
    if (stop && stop()) return;
    for (int x = 0; x < width; ++x) {
      Rgb sum, weight{1, 1, 1};
      tracer.follow(x + Real(0.5), y + Real(0.5), [&](const Met<Real>& met) {
        const Material& material = scene.materials[met.material];
        for (std::size_t light = 0; light < scene.lights.size(); ++light)
          if (const auto arrival = tracer.arrival(light, met))
            sum = sum + weight * (double(arrival->falloff) * strength(scene.lights[light])) *
                            reflectance(met, *arrival);
        const Rgb mirror = material.mirror_reflectance;
        weight = weight * reflected(material.fresnel, mirror, mirror_f90(mirror),
                                    dot(met.normal, met.to_eye));
      });
      picture[std::size_t(y) * width + x] = sum;
    }
  });
  return picture;
}

template <class Real>
std::vector<Rgb> evaluate_in(const Scene& scene, const std::function<bool()>& stop) {
  const std::vector<Finish> finishes(scene.materials.begin(), scene.materials.end());
  return trace<Real>(scene, stop, [&](const Met<Real>& met, const Arrival<Real>& arrival) {
    return finishes[met.material].reflectance(met, arrival);
  });
}

Vec3 rounded(const Vector<double>& v) { return {v.x, v.y, v.z}; }

}  // namespace

std::string why_not_evaluated(const Scene& scene) {
  if (!std::all_of(scene.lights.begin(), scene.lights.end(), is_delta))
    return "formulas per pixel are of directional and point lights; this scene has a light with a size";
  if (scene.camera.aperture_radius > 0)
    return "formulas per pixel are of a pinhole camera; this scene's has a lens (aperture_radius)";
  if (scene.sampler.sample_count > 1)
    return fmt::format(
        "formulas per pixel are of one ray per pixel centre; this scene asks for {} samples per pixel",
        scene.sampler.sample_count);
  if (scene.depth.glossy > 0)
    return "formulas per pixel are of direct light and perfect mirrors; this scene asks for "
           "inter-reflection (glossy_depth)";
  if (scene.spheres.size() > kMaxSpheresByRay)
    return fmt::format("formulas per pixel are of up to {} spheres; this scene has {}",
                       kMaxSpheresByRay, scene.spheres.size());
  return {};
}

std::vector<Rgb> evaluate(const Scene& scene, Digits digits, const std::function<bool()>& stop) {
  return digits == Digits::kFifty ? evaluate_in<Big>(scene, stop)
                                  : evaluate_in<double>(scene, stop);
}

std::vector<Rgb> shade(const Scene& scene, const Reflectance& reflectance) {
  return trace<double>(scene, {}, [&](const Met<double>& met, const Arrival<double>& arrival) {
    return reflectance(rounded(met.normal), rounded(met.to_eye), rounded(arrival.to_light));
  });
}

Image as_picture(const std::vector<Rgb>& radiance, const Film& film) {
  Image image(film.width, film.height);
  float* value = image.values().data();
  for (const Rgb& c : radiance)
    for (const double component : {c.r, c.g, c.b}) *value++ = float(component);
  return image;
}

}  // namespace lobelia::truth
