#include "renderer/waves/waves.hpp"

namespace lobelia::waves {

PreparedMaterial::PreparedMaterial(const Material& m) : material(m), reflector(m) {
  const double coefficient = radiance_coefficient(m.highlight);
  const Rgb f0 = m.specular_reflectance;
  specular = coefficient * f0;
  if (m.fresnel == Fresnel::kSchlick) grazing = coefficient * Rgb{1 - f0.r, 1 - f0.g, 1 - f0.b};
  diffuse = std::numbers::inv_pi * m.diffuse_reflectance;
}

PreparedScene::PreparedScene(const Scene& s, const Plan& p)
    : scene(s),
      plan(p),
      frame(camera_frame(s.camera, s.film)),
      // One ray a pixel goes through the centre, whatever the filter.
      filter(s.sampler.sample_count > 1 ? s.film.filter : Filter{}),
      materials(s.materials.begin(), s.materials.end()),
      lights(prepare(s.lights)),
      any_sized(!std::ranges::all_of(s.lights, is_delta)) {
  for (std::size_t l = 0; l < lights.size(); ++l)
    for (std::size_t m = 0; m < materials.size(); ++m)
      materials[m].scatters_to_light |=
          !is_delta(s.lights[l]) && p.strategy[l][m] != LightStrategy::kLight;
  for (const Plane& plane : s.planes) checkers.push_back(tangents(plane.normal));
  for (std::size_t k = 0; k < s.spheres.size(); ++k)
    if (length(s.spheres[k].center - s.camera.origin) <=
        outer_radius(s.spheres[k]) + s.camera.aperture_radius)
      around_camera.push_back(int(k));
  one_by_one = s.spheres.size() <= kMaxLoopSpheres && occluders_by_surface(s);
  if (s.spheres.size() > kMaxLoopSpheres ||
      (!s.spheres.empty() && (!one_by_one || p.draws_area_light || p.draws_lamp)))
    accelerator = std::make_unique<Accelerator>(s.spheres);
  std::vector<int> area, many_lamps;
  for (std::size_t l = 0; l < s.lights.size(); ++l)
    if (p.draws_area_light && is_area(s.lights[l]))
      area.push_back(int(l));
    else if (p.draws_lamp && is_delta(s.lights[l]))
      many_lamps.push_back(int(l)), lamps.push_back(l);
    else
      single_lights.push_back(l);
  const double close = closeness(s);
  if (p.draws_area_light) {
    area_tree.emplace(s.lights, area, close);
    first_of_tree = std::size_t(area.front());
  }
  if (p.draws_lamp) lamp_tree.emplace(s.lights, many_lamps, close);
}

Wave& Workspace::new_wave(int level, Wave::Kind kind) {
  const std::size_t at = place_of(level, kind);
  if (waves.size() <= at) waves.resize(at + 1);
  if (!waves[at]) waves[at] = std::make_unique<Wave>();
  waves[at]->kind = kind;
  waves[at]->level = level;
  waves[at]->count = 0;
  return *waves[at];
}

namespace {

/// Copies some rays of a wave into work.hits.
void gather(const Wave& wave, std::span<const int> rays, Workspace& work) {
  Hits& hits = work.hits;
  hits.count = rays.size();
  for (std::size_t j = 0; j < rays.size(); ++j) {
    const std::size_t i = std::size_t(rays[j]), slot = std::size_t(wave.slot[i]);
    copy(wave.point, i, hits.point, j);
    copy(wave.normal, i, hits.normal, j);
    copy(wave.to_eye, i, hits.to_eye, j);
    hits.weight[j] = wave.weight[i];
    hits.slot[j] = wave.slot[i];
    hits.pixel[j] = work.pixel[slot];
    hits.index[j] = work.index[slot];
    hits.surface[j] = int(wave.surface[i]);
  }
}

/// Sorts the rays that have met a surface by key_of(ray), into `rays`. There are few keys.
template <class Key>
void group(const Wave& wave, const Key& key_of, std::array<int, kChunk>& rays, Workspace& work) {
  std::array<int, kChunk> group_of;
  std::vector<int>& keys = work.keys;
  keys.clear();
  work.group_size.clear();
  std::size_t last = 0;
  for (std::size_t i = 0; i < wave.count; ++i) {
    group_of[i] = -1;
    if (wave.surface[i] < 0) continue;
    const int key = key_of(i);
    if (last >= keys.size() || keys[last] != key) {
      last = std::size_t(std::ranges::find(keys, key) - keys.begin());
      if (last == keys.size()) {
        keys.push_back(key);
        work.group_size.push_back(0);
      }
    }
    group_of[i] = int(last);
    ++work.group_size[last];
  }
  std::vector<std::size_t>& begin = work.group_begin;
  begin.assign(keys.size() + 1, 0);
  for (std::size_t g = 0; g < keys.size(); ++g) begin[g + 1] = begin[g] + work.group_size[g];
  work.group_next = begin;
  for (std::size_t i = 0; i < wave.count; ++i)
    if (group_of[i] >= 0) rays[work.group_next[std::size_t(group_of[i])]++] = int(i);
}

/// Shades in groups, so that a whole run of lanes has the same material and, where surfaces are few, the same
/// occluders.
void shade(const PreparedScene& prepared, const Wave& wave, Workspace& work) {
  const int materials = int(prepared.materials.size());
  const bool one_by_one = prepared.one_by_one;
  const auto key_of = [&](std::size_t i) {
    const int material = material_at(prepared, wave, i);
    return one_by_one ? int(wave.surface[i]) * materials + material : material;
  };
  std::array<int, kChunk> rays;
  group(wave, key_of, rays, work);
  for (std::size_t g = 0; g < work.keys.size(); ++g) {
    gather(wave, std::span(rays).subspan(work.group_begin[g], work.group_size[g]), work);
    const int key = work.keys[g];
    work.hits.material = one_by_one ? key % materials : key;
    work.hits.one_surface = one_by_one ? key / materials : -1;
    light_hits(prepared, wave, work);
    spawn_onward(prepared, wave, work);
  }
}

void follow(const PreparedScene& prepared, Wave& wave, Workspace& work) {
  trace(prepared, wave, work);
  if (prepared.any_sized) add_met_lights(prepared, wave, work);
  if (wave.lights_only) return;
  start_onward(wave, work);
  shade(prepared, wave, work);
  for (const auto kind : {Wave::Kind::kMirror, Wave::Kind::kScattered})
    if (Wave& next = work.wave_at(wave.level + 1, kind); next.count > 0)
      follow(prepared, next, work);
}

}  // namespace

void render(const PreparedScene& prepared, std::span<const PixelSample> samples,
            std::span<SampleResult> results, Workspace& work) {
  Wave& wave = work.new_wave(0, Wave::Kind::kCamera);
  start(prepared, samples, results, wave, work);
  follow(prepared, wave, work);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    results[i].surface = int(wave.surface[i]);
    results[i].radiance = work.radiance[i];
  }
}

}  // namespace lobelia::waves
