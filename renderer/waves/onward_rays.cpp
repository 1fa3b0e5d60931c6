
#include "renderer/sobol.hpp"
#include "renderer/waves/waves.hpp"

namespace lobelia::waves {
namespace {

/// After so many reflections a path goes on with a probability that follows the light it can bring.
constexpr int kRouletteFrom = 4;

/// A camera ray may go on as a mirrored and as a scattered ray. Later rays draw one of the two, so that the number
/// of rays does not double with every reflection.
bool takes_mirror(double random) { return random < 0.5; }

void spawn_mirrored(const PreparedScene& prepared, const Wave& wave, bool one_of_two, Wave& next,
                    Workspace& work) {
  const Hits& hits = work.hits;
  const Material& material = prepared.materials[std::size_t(hits.material)].material;
  const std::size_t before = next.count;
  const double at_grazing = mirror_at_grazing(material.mirror_reflectance);
  if (one_of_two) work.draw(wave, kChoice);
  for (std::size_t i = 0; i < hits.count; ++i) {
    if (one_of_two && !takes_mirror(work.random.u[i])) continue;
    const Vec3 normal = get(hits.normal, i), to_eye = get(hits.to_eye, i);
    const double n_dot_v = dot(normal, to_eye);
    const Vec3 mirrored = normalize(2 * n_dot_v * normal - to_eye);
    const Rgb reflectance =
        fresnel_factor(material.fresnel, material.mirror_reflectance, to_eye, mirrored, at_grazing);
    const std::size_t to = next.count++;
    copy(hits.point, i, next.origin, to);
    put(-mirrored, next.to_eye, to);
    next.leaves[to] = hits.surface[i];
    next.weight[to] = (one_of_two ? 2.0 : 1.0) * hits.weight[i] * reflectance;
    next.slot[to] = hits.slot[i];
  }
  work.work.mirror_rays += next.count - before;
  work.work.of<effects::Mirror>() += next.count - before;
}

void spawn_scattered(const PreparedScene& prepared, const Wave& wave, bool one_of_two, Wave& next,
                     Workspace& work) {
  const Hits& hits = work.hits;
  const PreparedMaterial& material = prepared.materials[std::size_t(hits.material)];
  const bool highlight = has_highlight(material.material);
  const bool even = prepared.plan.experiment.directions == Experiment::Directions::kEven;
  const bool roulette = wave.level >= kRouletteFrom;
  // With all effects forced, rays that nothing calls for are traced and bring nothing.
  const bool forced = wave.left.glossy < 1 && !material.scatters_to_light;
  const RandomPairs& random = work.random;
  const std::size_t before = next.count;
  std::array<bool, kChunk> skipped{};
  if (one_of_two) {
    work.draw(wave, kChoice);
    for (std::size_t i = 0; i < hits.count; ++i) skipped[i] = takes_mirror(random.u[i]);
  }
  std::array<double, kChunk> choice, chance;  // of highlight or base; of going on
  if (highlight || roulette) {
    work.draw(wave, kScatter);
    std::copy_n(random.u, hits.count, choice.begin());
    std::copy_n(random.v, hits.count, chance.begin());
  }
  work.draw(wave, kDirection);
  if (!highlight && !even)
    kernels().scatter_evenly(hits.count, hits.normal, random.u, random.v, work.scattered);
  for (std::size_t i = 0; i < hits.count; ++i) {
    if (skipped[i]) continue;
    const Vec3 normal = get(hits.normal, i);
    std::optional<ReflectorSample> drawn;
    if (even) {
      const Vec3 to_light = about(normal, random.u[i], random.v[i]);
      drawn = {to_light, material.reflector.eval(normal, get(hits.to_eye, i), to_light),
               std::numbers::inv_pi / 2};
    } else if (highlight) {
      drawn = material.reflector.sample_above(normal, get(hits.to_eye, i), choice[i], random.u[i],
                                              random.v[i]);
    } else {
      const Vec3 to_light = get(work.scattered, i);
      const double cosine = dot(normal, to_light);
      if (cosine > 0) drawn = {to_light, cosine * material.diffuse, cosine * std::numbers::inv_pi};
    }
    if (!drawn) continue;
    Rgb weight = (forced       ? 0.0
                  : one_of_two ? 2 / drawn->pdf
                               : 1 / drawn->pdf) *
                 hits.weight[i] * drawn->radiance;
    if (roulette) {
      const double survival = std::min(1.0, max_component(weight));
      if (!(chance[i] < survival)) continue;
      weight = 1 / survival * weight;
    }
    const std::size_t to = next.count++;
    copy(hits.point, i, next.origin, to);
    if (prepared.area_tree) copy(hits.normal, i, next.normal_at_origin, to);
    put(-drawn->to_light, next.to_eye, to);
    next.leaves[to] = hits.surface[i];
    next.weight[to] = weight;
    next.slot[to] = hits.slot[i];
    next.pdf[to] = drawn->pdf;
    next.material[to] = hits.material;
  }
  work.work.scattered_rays += next.count - before;
  if (wave.left.glossy > 0 || forced) work.work.of<effects::Glossy>() += next.count - before;
}

}  // namespace

void start_onward(const Wave& wave, Workspace& work) {
  Wave& mirrored = work.new_wave(wave.level + 1, Wave::Kind::kMirror);
  Wave& scattered = work.new_wave(wave.level + 1, Wave::Kind::kScattered);
  mirrored.left = {wave.left.mirror - 1, wave.left.glossy};
  mirrored.lights_only = wave.left.mirror < 1;
  mirrored.branch = sobol::hash(wave.branch + 1);
  scattered.left = {wave.left.mirror, wave.left.glossy - 1};
  scattered.lights_only = wave.left.glossy < 1;
  scattered.branch = sobol::hash(wave.branch + 2);
}

void spawn_onward(const PreparedScene& prepared, const Wave& wave, Workspace& work) {
  const PreparedMaterial& material = prepared.materials[std::size_t(work.hits.material)];
  const bool all = prepared.all_effects();
  const bool is_mirror = all || !is_black(material.material.mirror_reflectance);
  const bool mirrors = is_mirror && prepared.plan.on<effects::Mirror>() &&
                       (wave.left.mirror > 0 || prepared.any_sized || (all && wave.level == 0));
  const bool scatters =
      wave.left.glossy > 0 || material.scatters_to_light || (all && wave.level == 0);
  const bool one_of_two = wave.level > 0 && mirrors && wave.left.glossy > 0;
  const int level = wave.level + 1;
  if (mirrors)
    spawn_mirrored(prepared, wave, one_of_two, work.wave_at(level, Wave::Kind::kMirror), work);
  if (scatters)
    spawn_scattered(prepared, wave, one_of_two, work.wave_at(level, Wave::Kind::kScattered), work);
}

}  // namespace lobelia::waves
