
#include "renderer/waves/waves.hpp"

namespace lobelia::waves {
namespace {

/// Veach's power heuristic with an exponent of 2: the weight of a draw of density `p` against one of density `q`.
double power_heuristic(double p, double q) {
  // Divides first, because either may be too large to square.
  const double r = q / p;
  return std::isfinite(r) ? 1 / (1 + r * r) : 0;
}

/// Whether the light draws directions, alone or with the surface.
bool draws(const PreparedScene& prepared, std::size_t light, int material) {
  return is_delta(prepared.scene.lights[light]) ||
         prepared.plan.strategy[light][std::size_t(material)] != LightStrategy::kSurface;
}

void weigh_against_surface(const PreparedScene& prepared, const Hits& hits, LightSamples& drawn) {
  const Reflector& reflector = prepared.materials[std::size_t(hits.material)].reflector;
  for (std::size_t i = 0; i < hits.count; ++i) {
    const Vec3 normal = get(hits.normal, i), to_light = get(drawn.to_light, i);
    if (drawn.factor[i] > 0 && dot(normal, to_light) > 0)
      drawn.factor[i] *= power_heuristic(
          1 / drawn.factor[i], reflector.pdf_above({normal, get(hits.to_eye, i), to_light}));
  }
}

/// The planned precision for a camera ray's surface, or the one for any direction.
Precision precision_of(const PreparedScene& prepared, std::size_t light, const Wave& wave,
                       const Hits& hits) {
  const auto& as_seen = prepared.plan.precision[light];
  if (wave.level == 0 && hits.one_surface >= 0 && std::size_t(hits.one_surface) < as_seen.size())
    return as_seen[std::size_t(hits.one_surface)];
  return prepared.plan.any_direction_precision[std::size_t(hits.material)];
}

/// Adds highlight, Fresnel factor and diffuse base under the light of work.drawn.
void reflect(const PreparedScene& prepared, std::size_t light, Precision precision,
             Workspace& work) {
  const Hits& hits = work.hits;
  const PreparedMaterial& material = prepared.materials[std::size_t(hits.material)];
  const Highlight& highlight = material.material.highlight;
  const Rgb emitted = strength(prepared.scene.lights[light]);
  const bool varies = info(prepared.scene.lights[light]).varies;
  const LightSamples& drawn = work.drawn;
  const auto add = [&](std::size_t i, double factor, Rgb reflectance, Rgb constant) {
    Rgb& sum = work.radiance[std::size_t(hits.slot[i])];
    sum = sum + factor * (varies ? reflectance * drawn.radiance[i] : constant) * hits.weight[i];
  };
  const bool all = prepared.all_effects();
  if (all || has_highlight(material.material)) {
    kernels().shade(highlight, precision)(highlight, hits.count, hits.normal, hits.to_eye,
                                          drawn.to_light, work.specular);
    const Rgb specular = emitted * material.specular;
    for (std::size_t i = 0; i < hits.count; ++i)
      add(i, drawn.factor[i] * work.specular[i], material.specular, specular);
  }
  if (all || material.material.fresnel != Fresnel::kNone) {
    const Rgb grazing = emitted * material.grazing;
    kernels().fresnel(hits.count, hits.to_eye, drawn.to_light, work.fresnel);
    for (std::size_t i = 0; i < hits.count; ++i)
      add(i, drawn.factor[i] * work.specular[i] * work.fresnel[i], material.grazing, grazing);
    work.work.of<effects::Fresnel>() += hits.count;
  }
  if (all || !is_black(material.material.diffuse_reflectance)) {
    const Rgb diffuse = emitted * material.diffuse;
    kernels().cosine(hits.count, hits.normal, drawn.to_light, work.n_dot_l);
    for (std::size_t i = 0; i < hits.count; ++i)
      add(i, drawn.factor[i] * work.n_dot_l[i], material.diffuse, diffuse);
    work.work.of<effects::Diffuse>() += hits.count;
  }
}

}  // namespace

void add_met_lights(const PreparedScene& prepared, const Wave& wave, Workspace& work) {
  const bool scattered = wave.kind == Wave::Kind::kScattered;
  for (std::size_t l = 0; l < prepared.scene.lights.size(); ++l) {
    const Light& light = prepared.scene.lights[l];
    const Rgb emitted = strength(light);
    if (is_delta(light) || (is_black(emitted) && !prepared.all_effects())) continue;
    const bool environment = is_environment(light);
    const bool on_surface = !prepared.plan.contacts[l].empty();
    if (!environment) {
      prepared.lights[l]->meet(wave.count, wave.origin, wave.to_eye, scattered, work.met);
      work.work.of<effects::AreaLights>() += wave.count;
    }
    for (std::size_t i = 0; i < wave.count; ++i) {
      if (!environment && !(work.met.distance[i] < std::numeric_limits<double>::infinity()))
        continue;
      bool hidden = environment ? wave.surface[i] >= 0 : !(work.met.distance[i] < wave.distance[i]);
      if (on_surface) {
        if (prepared.plan.lies_on(l, int(wave.leaves[i]))) continue;
        hidden &= !prepared.plan.lies_on(l, int(wave.surface[i]));
      }
      if (hidden && (prepared.plan.experiment.shadows || !scattered)) continue;
      const LightStrategy strategy = scattered
                                         ? prepared.plan.strategy[l][std::size_t(wave.material[i])]
                                         : LightStrategy::kSurface;
      if (strategy == LightStrategy::kLight) continue;
      EnvironmentLook seen{emitted, scattered ? work.met.pdf[i] : 0};
      if (environment) {
        seen = prepared.lights[l]->look(-get(wave.to_eye, i));
        ++work.work.of<effects::Environment>();
      }
      const double share =
          strategy == LightStrategy::kBoth ? power_heuristic(wave.pdf[i], seen.pdf) : 1;
      Rgb& sum = work.radiance[std::size_t(wave.slot[i])];
      sum = sum + share * seen.radiance * wave.weight[i];
    }
  }
}

void light_hits(const PreparedScene& prepared, const Wave& wave, Workspace& work) {
  const Hits& hits = work.hits;
  for (std::size_t l = 0; l < prepared.lights.size(); ++l) {
    if (prepared.plan.lies_on(l, hits.one_surface) || !draws(prepared, l, hits.material)) continue;
    const Light& light = prepared.scene.lights[l];
    LightSamples& drawn = work.drawn;
    if (is_delta(light)) {
      prepared.lights[l]->sample(hits.count, hits.point, nullptr, nullptr, drawn);
    } else {
      if (is_black(strength(light)) && !prepared.all_effects()) continue;
      work.draw(wave, kLight + std::uint32_t(l));
      prepared.lights[l]->sample(hits.count, hits.point, work.random.u, work.random.v, drawn);
      for (std::size_t i = 0; i < hits.count; ++i)
        if (!(drawn.factor[i] > 0)) {
          copy(hits.normal, i, drawn.to_light, i);
          drawn.factor[i] = 0;
        }
      if (prepared.plan.strategy[l][std::size_t(hits.material)] == LightStrategy::kBoth)
        weigh_against_surface(prepared, hits, drawn);
      (is_environment(light) ? work.work.of<effects::Environment>()
                             : work.work.of<effects::AreaLights>()) += hits.count;
    }
    hide(prepared, l, work);
    reflect(prepared, l, precision_of(prepared, l, wave, hits), work);
  }
}

}  // namespace lobelia::waves
