#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include "base/system/error.hpp"
#include "reference_scenes/engines/analytic/formulas/big.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "reference_scenes/engines/analytic/formulas/tracer.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"

namespace lobelia::truth {

struct Picture::Pixels {
  /// One light on one pixel that it lights.
  struct Lit {
    std::size_t pixel;
    Big n_dot_l, n_dot_v;
    Big cosine[2];   ///< of the lobe's angle, by LobeAngle
    Rgb irradiance;  ///< times the specular reflectance
  };
  std::vector<int> sphere;
  std::vector<Lit> lit;
  double peak = 0;
  /// Values of lobes, which models with the same angle share.
  std::map<std::tuple<LobeAngle, LobeId, double>, std::vector<Big>> lobes;
  std::mutex mutex;
};

Picture::Picture(const Scene& scene) : pixels_(std::make_unique<Pixels>()) {
  if (const std::string found = beyond_delta_lights(scene); !found.empty())
    throw Error(ExitCode::kInternal, "the truth of 50 digits does not know: " + found);
  const Tracer<Big> tracer(scene);
  for (int y = 0; y < scene.film.height; ++y)
    for (int x = 0; x < scene.film.width; ++x) {
      const std::size_t pixel = pixels_->sphere.size();
      const auto met =
          tracer.meet(tracer.camera_origin(), tracer.camera_ray(x + Big(0.5), y + Big(0.5)));
      pixels_->sphere.push_back(met ? met->surface : -1);
      if (!met) continue;
      const Rgb reflectance = scene.materials[met->material].specular_reflectance;
      for (std::size_t light = 0; light < scene.lights.size(); ++light)
        if (const auto arrival = tracer.arrival(light, *met)) {
          const auto cosine = [&](LobeAngle angle) {
            return lobe_cosine(angle, met->normal, met->to_eye, arrival->to_light);
          };
          pixels_->lit.push_back(
              {pixel,
               arrival->n_dot_l,
               dot(met->normal, met->to_eye),
               {cosine(LobeAngle::kReflection), cosine(LobeAngle::kHalfVector)},
               double(arrival->falloff) * (strength(scene.lights[light]) * reflectance)});
        }
    }
  std::map<std::size_t, double> arriving;
  for (const auto& lit : pixels_->lit) {
    double& here = arriving[lit.pixel];
    here += max_component(lit.irradiance);
    pixels_->peak = std::max(pixels_->peak, here);
  }
}

Picture::~Picture() = default;
Picture::Picture(Picture&&) noexcept = default;

int Picture::sphere(std::size_t pixel) const { return pixels_->sphere.at(pixel); }
double Picture::peak() const { return pixels_->peak; }

std::vector<Rgb> Picture::highlights(const Highlight& highlight) const {
  const ModelRow& model = model_row(highlight.model);
  const LobeId lobe = highlight.lobe;
  const std::lock_guard lock(pixels_->mutex);
  auto& values = pixels_->lobes[{model.angle, lobe, highlight.exponent}];
  if (values.empty())
    for (const auto& lit : pixels_->lit)
      values.push_back(
          lobe_of_cosine(lobe, lit.cosine[std::size_t(model.angle)], highlight.exponent));
  const double factor = coefficient(highlight.model, lobe, highlight.exponent);
  std::vector<Rgb> radiance(pixels_->sphere.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& lit = pixels_->lit[i];
    const Big share = values[i] * geometry(model, highlight.exponent, lit.n_dot_l, lit.n_dot_v);
    Rgb& sum = radiance[lit.pixel];
    sum = sum + factor * double(share) * lit.irradiance;
  }
  return radiance;
}

}  // namespace lobelia::truth
