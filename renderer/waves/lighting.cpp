
#include "renderer/waves/waves.hpp"

namespace lobelia::waves {
namespace {

/// Veach's power heuristic with an exponent of 2: the weight of a draw of density `p` against one of density `q`.
double power_heuristic(double p, double q) {
  // Divides first, because either may be too large to square.
  const double r = q / p;
  return std::isfinite(r) ? 1 / (1 + r * r) : 0;
}

/// Whether the light draws directions, alone or with the surface. The same for all area lights.
bool draws(const PreparedScene& prepared, std::size_t light, int material) {
  if (is_delta(prepared.scene.lights[light])) return true;
  const LightStrategy strategy = prepared.plan.strategy[light][std::size_t(material)];
  return strategy == LightStrategy::kBoth && is_environment(prepared.scene.lights[light])
             ? prepared.lights[light]->has_bright()
             : strategy != LightStrategy::kSurface;
}

/// Whether draws by the light and by the surface are weighted against each other. Without a highlight, the surface
/// brings nothing of what an environment draws.
bool are_weighted(const PreparedScene& prepared, std::size_t light, int material) {
  return prepared.plan.strategy[light][std::size_t(material)] == LightStrategy::kBoth &&
         (!is_environment(prepared.scene.lights[light]) || prepared.all_effects() ||
          has_highlight(prepared.materials[std::size_t(material)].material));
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

/// Adds highlight, Fresnel factor and diffuse base under the light of work.drawn: of one strength, or each of its own
/// radiance.
void reflect(const PreparedScene& prepared, Rgb emitted, bool varies, Precision precision,
             Workspace& work) {
  const Hits& hits = work.hits;
  const PreparedMaterial& material = prepared.materials[std::size_t(hits.material)];
  const Highlight& highlight = material.material.highlight;
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

/// Zero, with a direction that every kernel takes, where there is none to the light.
void leave_out_unlit(const Hits& hits, LightSamples& drawn) {
  for (std::size_t i = 0; i < hits.count; ++i)
    if (!(drawn.factor[i] > 0)) {
      copy(hits.normal, i, drawn.to_light, i);
      drawn.factor[i] = 0;
    }
}

/// Samples the light of work.chosen for each hit into work.drawn, divided by its probability. Hits of the same light
/// are sampled together.
void sample_chosen(const PreparedScene& prepared, Workspace& work) {
  const Hits& hits = work.hits;
  LightSamples& drawn = work.drawn;
  const auto light_at = [&](std::size_t i) { return work.chosen[i].light; };
  work.by_light.resize(hits.count);
  for (std::size_t i = 0; i < hits.count; ++i) work.by_light[i] = std::uint16_t(i);
  std::ranges::sort(work.by_light, [&](std::size_t a, std::size_t b) {
    return light_at(a) != light_at(b) ? light_at(a) < light_at(b) : a < b;
  });
  for (std::size_t begin = 0, end; begin < hits.count; begin = end) {
    const int light = light_at(work.by_light[begin]);
    for (end = begin; end < hits.count && light_at(work.by_light[end]) == light; ++end) {
      const std::size_t i = work.by_light[end], to = end - begin;
      copy(hits.point, i, work.part_point, to);
      work.part_random.u[to] = work.random.u[i];
      work.part_random.v[to] = work.random.v[i];
      drawn.factor[i] = 0;
    }
    if (light < 0) continue;
    prepared.lights[std::size_t(light)]->sample(end - begin, work.part_point, work.part_random.u,
                                                work.part_random.v, work.part_drawn);
    const Rgb emitted = strength(prepared.scene.lights[std::size_t(light)]);
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = work.by_light[k], from = k - begin;
      copy(work.part_drawn.to_light, from, drawn.to_light, i);
      drawn.distance[i] = work.part_drawn.distance[from];
      drawn.factor[i] = work.part_drawn.factor[from] / work.chosen[i].probability;
      drawn.radiance[i] = emitted;
    }
  }
  leave_out_unlit(hits, drawn);
}

/// The light of one of the tree's lights, drawn for each hit.
void light_by_one_of(const LightTree& tree, const PreparedScene& prepared, const Wave& wave,
                     Dimension dimension, Workspace& work) {
  const Hits& hits = work.hits;
  work.draw(wave, dimension);
  for (std::size_t i = 0; i < hits.count; ++i)
    work.chosen[i] = tree.choose(get(hits.point, i), get(hits.normal, i), work.random.u[i]);
  const bool area = dimension == kAreaLight;
  if (area) work.draw(wave, kPointOfLight);
  sample_chosen(prepared, work);
  if (area) {
    if (prepared.area_strategy(hits.material) == LightStrategy::kBoth)
      weigh_against_surface(prepared, hits, work.drawn);
    work.work.of<effects::AreaLights>() += hits.count;
  }
  hide_chosen(prepared, work);
  reflect(prepared, {}, true, prepared.plan.any_direction_precision[std::size_t(hits.material)],
          work);
}

/// The part of add_met_lights() for an area light.
struct MetLight {
  const PreparedScene& prepared;
  const Wave& wave;
  std::size_t index;
  Rgb emitted = strength(prepared.scene.lights[index]);
  bool on_surface = !prepared.plan.contacts[index].empty();
  bool scattered = wave.kind == Wave::Kind::kScattered;

  /// Adds the light that a ray meets at a distance, and that the light draws with a density.
  void add(std::size_t i, double distance, double pdf, Workspace& work) const {
    if (!(distance < std::numeric_limits<double>::infinity())) return;
    bool hidden = !(distance < wave.distance[i]);
    if (on_surface) {
      if (prepared.plan.lies_on(index, int(wave.leaves[i]))) return;
      hidden &= !prepared.plan.lies_on(index, int(wave.surface[i]));
    }
    if (hidden) return;
    const LightStrategy strategy =
        scattered ? prepared.plan.strategy[index][std::size_t(wave.material[i])]
                  : LightStrategy::kSurface;
    if (strategy == LightStrategy::kLight) return;
    const double share = strategy == LightStrategy::kBoth ? power_heuristic(wave.pdf[i], pdf) : 1;
    Rgb& sum = work.radiance[std::size_t(wave.slot[i])];
    sum = sum + share * emitted * wave.weight[i];
  }
};

/// The part of it for an environment.
void add_met_environment(const PreparedScene& prepared, const Wave& wave, std::size_t l,
                         Workspace& work) {
  const bool scattered = wave.kind == Wave::Kind::kScattered;
  const auto strategy = [&](std::size_t i) {
    return scattered ? prepared.plan.strategy[l][std::size_t(wave.material[i])]
                     : LightStrategy::kSurface;
  };
  work.looking.clear();
  for (std::size_t i = 0; i < wave.count; ++i)
    if (wave.surface[i] < 0 && strategy(i) != LightStrategy::kLight) {
      copy(wave.to_eye, i, work.part_to_eye, work.looking.size());
      work.looking.push_back(int(i));
    }
  prepared.lights[l]->look(work.looking.size(), work.part_to_eye, work.looks.data());
  work.work.of<effects::Environment>() += work.looking.size();
  for (std::size_t k = 0; k < work.looking.size(); ++k) {
    const std::size_t i = std::size_t(work.looking[k]);
    const EnvironmentLook& seen = work.looks[k];
    double share = 1;
    if (strategy(i) == LightStrategy::kBoth)
      share =
          are_weighted(prepared, l, wave.material[i]) ? power_heuristic(wave.pdf[i], seen.pdf) : 0;
    Rgb& sum = work.radiance[std::size_t(wave.slot[i])];
    sum = sum + (seen.smooth + share * seen.bright) * wave.weight[i];
  }
}

/// Adds the radiance of the area lights that one is drawn of.
void add_met_lights_of_tree(const PreparedScene& prepared, const Wave& wave, Workspace& work) {
  const bool scattered = wave.kind == Wave::Kind::kScattered;
  work.looking.clear();
  for (std::size_t i = 0; i < wave.count; ++i)
    if (!scattered || prepared.area_strategy(wave.material[i]) != LightStrategy::kLight)
      work.looking.push_back(int(i));
  const LightTree& tree = *prepared.area_tree;
  tree.find_met({wave.origin, wave.to_eye, wave.distance}, work.looking,
                [&](int index, std::span<const int> rays) {
                  for (std::size_t k = 0; k < rays.size(); ++k) {
                    copy(wave.origin, std::size_t(rays[k]), work.part_point, k);
                    copy(wave.to_eye, std::size_t(rays[k]), work.part_to_eye, k);
                  }
                  const MetLight light{prepared, wave, std::size_t(index)};
                  prepared.lights[light.index]->meet(rays.size(), work.part_point, work.part_to_eye,
                                                     scattered, work.met);
                  work.work.of<effects::AreaLights>() += rays.size();
                  for (std::size_t k = 0; k < rays.size(); ++k) {
                    const std::size_t i = std::size_t(rays[k]);
                    if (!(work.met.distance[k] < std::numeric_limits<double>::infinity())) continue;
                    const double pdf =
                        scattered
                            ? work.met.pdf[k] * tree.probability(index, get(wave.origin, i),
                                                                 get(wave.normal_at_origin, i))
                            : 0;
                    light.add(i, work.met.distance[k], pdf, work);
                  }
                });
}

/// The light of a single light of the scene.
void light_by(std::size_t l, const PreparedScene& prepared, const Wave& wave, Workspace& work) {
  const Hits& hits = work.hits;
  if (prepared.plan.lies_on(l, hits.one_surface) || !draws(prepared, l, hits.material)) return;
  const Light& light = prepared.scene.lights[l];
  LightSamples& drawn = work.drawn;
  if (is_delta(light)) {
    prepared.lights[l]->sample(hits.count, hits.point, nullptr, nullptr, drawn);
  } else {
    work.draw(wave, kLight + std::uint32_t(l));
    const auto strategy = prepared.plan.strategy[l][std::size_t(hits.material)];
    if (is_environment(light) && strategy == LightStrategy::kBoth)
      prepared.lights[l]->sample_bright(hits.count, work.random.u, work.random.v, drawn);
    else
      prepared.lights[l]->sample(hits.count, hits.point, work.random.u, work.random.v, drawn);
    leave_out_unlit(hits, drawn);
    if (are_weighted(prepared, l, hits.material)) weigh_against_surface(prepared, hits, drawn);
    (is_environment(light) ? work.work.of<effects::Environment>()
                           : work.work.of<effects::AreaLights>()) += hits.count;
  }
  hide(prepared, l, work);
  reflect(prepared, strength(light), info(light).varies, precision_of(prepared, l, wave, hits),
          work);
}

}  // namespace

void add_met_lights(const PreparedScene& prepared, const Wave& wave, Workspace& work) {
  for (const std::size_t l : prepared.single_lights) {
    const Light& one = prepared.scene.lights[l];
    if (is_delta(one)) continue;
    if (is_environment(one)) {
      add_met_environment(prepared, wave, l, work);
      continue;
    }
    const MetLight light{prepared, wave, l};
    prepared.lights[l]->meet(wave.count, wave.origin, wave.to_eye, light.scattered, work.met);
    work.work.of<effects::AreaLights>() += wave.count;
    for (std::size_t i = 0; i < wave.count; ++i)
      light.add(i, work.met.distance[i], light.scattered ? work.met.pdf[i] : 0, work);
  }
  if (prepared.area_tree) add_met_lights_of_tree(prepared, wave, work);
}

void light_hits(const PreparedScene& prepared, const Wave& wave, Workspace& work) {
  for (const std::size_t l : prepared.single_lights) light_by(l, prepared, wave, work);
  if (prepared.area_tree && prepared.area_strategy(work.hits.material) != LightStrategy::kSurface)
    light_by_one_of(*prepared.area_tree, prepared, wave, kAreaLight, work);
  // At the first surface the exact sum costs no noise.
  if (wave.level > 0 && prepared.lamp_tree)
    light_by_one_of(*prepared.lamp_tree, prepared, wave, kLamp, work);
  else
    for (const std::size_t l : prepared.lamps) light_by(l, prepared, wave, work);
}

}  // namespace lobelia::waves
