#include "renderer/wave_renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "renderer/chord.hpp"
#include "renderer/frame.hpp"
#include "renderer/kernels/wave.hpp"
#include "renderer/sobol.hpp"

namespace lobelia {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Sphere kUnitSphere{};
/// After so many reflections a path goes on only with a probability, by how much light it can bring.
constexpr int kRouletteFrom = 4;

/// Pairs of random numbers that a wave's rays take; 0 and 1 are the camera's, of the pixel and the lens.
constexpr std::uint32_t kChoiceDimension = 2, kScatterDimension = 3, kDirectionDimension = 4,
                        kLightDimension = 8;

void copy(const Vec3Chunk& from, std::size_t i, Vec3Chunk& to, std::size_t j) {
  to.x[j] = from.x[i];
  to.y[j] = from.y[i];
  to.z[j] = from.z[i];
}
Vec3 get(const Vec3Chunk& from, std::size_t i) { return {from.x[i], from.y[i], from.z[i]}; }
void put(Vec3 v, Vec3Chunk& to, std::size_t i) { to.x[i] = v.x, to.y[i] = v.y, to.z[i] = v.z; }

/// From the camera a path that could go on both ways does; after that one is drawn, lest the number of
/// rays double with every reflection.
bool takes_mirror(double random) { return random < 0.5; }

/// Veach's power heuristic with an exponent of 2: the weight of a draw of density `p` where another
/// way would have drawn it with `q`.
double power_heuristic(double p, double q) {
  // Divided first, for either may be too large to be squared.
  const double r = q / p;
  return std::isfinite(r) ? 1 / (1 + r * r) : 0;
}

}  // namespace

/// What shading needs of a material, computed once for the picture.
struct WaveRenderer::PreparedMaterial {
  Material material;
  Reflector reflector;
  Rgb specular;                    ///< reflectance times coefficient
  Rgb grazing;                     ///< what Schlick's factor adds to it at grazing angles, at most
  Rgb diffuse;                     ///< reflectance / pi
  bool scatters_to_light = false;  ///< some light's directions are drawn by the surface

  explicit PreparedMaterial(const Material& m) : material(m), reflector(m) {
    const double coefficient = radiance_coefficient(m.highlight);
    const Rgb f0 = m.specular_reflectance;
    specular = coefficient * f0;
    if (m.fresnel == Fresnel::kSchlick) grazing = coefficient * Rgb{1 - f0.r, 1 - f0.g, 1 - f0.b};
    diffuse = std::numbers::inv_pi * m.diffuse_reflectance;
  }
};

/// Hits that are shaded together.
struct WaveRenderer::Group {
  int material;
  int surface;  ///< the same for all; -1 where they differ
};

/// Rays that have gone equally far.
struct WaveRenderer::Wave {
  enum class Kind { kCamera, kMirror, kScattered };
  Kind kind = Kind::kCamera;
  int level = 0;             ///< reflections so far
  Depth left;                ///< how many more of each kind are traced
  bool lights_only = false;  ///< to lights: what is met otherwise only hides them
  std::uint32_t branch = 0;  ///< distinguishes the random numbers of a level's waves
  std::size_t count = 0;
  Vec3Chunk origin{}, to_eye{};         ///< rays run opposite to `to_eye`
  alignas(64) double leaves[kChunk]{};  ///< the surface where it starts; -1: none
  alignas(64) double distance[kChunk]{}, surface[kChunk]{};
  std::array<Rgb, kChunk> weight;
  std::array<int, kChunk> slot;  ///< which camera ray it goes back to
  // Of scattered rays: what they were drawn with, to weigh them against the lights' own draws.
  std::array<double, kChunk> pdf;
  std::array<int, kChunk> material;
  // Filled where a surface is met.
  Vec3Chunk point{}, normal{};
};

struct WaveRenderer::Workspace {
  Work work;
  std::vector<std::unique_ptr<Wave>> waves;        ///< two for each level: mirrored, scattered
  std::array<std::uint32_t, kChunk> pixel, index;  ///< of the camera rays
  std::array<Rgb, kChunk> radiance;
  Vec3Chunk center{};
  alignas(64) double radius[kChunk]{};
  alignas(64) double u[kChunk]{}, v[kChunk]{}, lens_u[kChunk]{}, lens_v[kChunk]{};
  // The hits of one group, side by side.
  std::array<int, kChunk> slot, surface;
  std::array<std::uint32_t, kChunk> hit_pixel, hit_index;
  std::array<Rgb, kChunk> tint;
  Vec3Chunk point{}, normal{}, to_eye{}, to_light{};
  alignas(64) double falloff[kChunk]{}, distance[kChunk]{}, visible[kChunk]{};
  alignas(64) double specular[kChunk]{}, n_dot_l[kChunk]{}, fresnel[kChunk]{};
  std::array<Rgb, kChunk> weight;
  std::vector<int> keys;  ///< of the groups of a wave, and their sizes and places
  std::vector<std::size_t> group_size, group_begin, group_next;
  DrawnChunk drawn;
  MetChunk met;

  Wave& wave_at(int level, Wave::Kind kind) {
    return *waves[2 * std::size_t(level) + (kind == Wave::Kind::kScattered)];
  }
  /// An empty one.
  Wave& new_wave(int level, Wave::Kind kind) {
    const std::size_t at = 2 * std::size_t(level) + (kind == Wave::Kind::kScattered);
    if (waves.size() <= at) waves.resize(at + 1);
    if (!waves[at]) waves[at] = std::make_unique<Wave>();
    waves[at]->kind = kind;
    waves[at]->level = level;
    waves[at]->count = 0;
    return *waves[at];
  }
  /// A pair of random numbers for each hit, in random_u and random_v.
  void draw(const Wave& wave, std::size_t hits, std::uint32_t dimension) {
    wave_kernels().random(hits, hit_pixel.data(), hit_index.data(), dimension ^ wave.branch,
                          random_u, random_v);
  }
  alignas(64) double random_u[kChunk]{}, random_v[kChunk]{};
};

void WaveRenderer::WorkspaceDeleter::operator()(Workspace* w) const { delete w; }
WaveRenderer::WorkspacePointer WaveRenderer::make_workspace() {
  return WorkspacePointer(new Workspace);
}
Work& WaveRenderer::work_of(Workspace& workspace) { return workspace.work; }

WaveRenderer::~WaveRenderer() = default;

WaveRenderer::WaveRenderer(const Scene& scene, const Plan& plan)
    : scene_(scene),
      plan_(plan),
      frame_(camera_frame(scene.camera, scene.film)),
      // One ray a pixel goes through the centre, whatever the filter.
      filter_(scene.sampler.sample_count > 1 ? scene.film.filter : Filter{}),
      one_by_one_(scene.spheres.size() <= kMaxLoopSpheres) {
  for (const Material& m : scene.materials) materials_.emplace_back(m);
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const auto* environment = std::get_if<EnvironmentLight>(&scene.lights[l]);
    environments_.push_back(environment ? std::make_unique<Environment>(*environment) : nullptr);
    const auto* rectangle = std::get_if<RectangleLight>(&scene.lights[l]);
    rectangles_.push_back(rectangle ? std::optional(PreparedRectangle(*rectangle)) : std::nullopt);
    if (is_delta(scene.lights[l])) continue;
    any_sized_ = true;
    for (std::size_t m = 0; m < materials_.size(); ++m)
      if (plan.strategy[l][m] != LightStrategy::kLight) materials_[m].scatters_to_light = true;
  }
  for (const Plane& plane : scene.planes) {
    const Tangents t = tangents(plane.normal);
    plane_u_.push_back(t.first);
    plane_v_.push_back(t.second);
  }
  if (!one_by_one_) accelerator_ = std::make_unique<Accelerator>(scene.spheres);
}

void WaveRenderer::render(std::span<const PixelSample> samples, std::span<SampleResult> results,
                          Workspace& work) const {
  camera_wave(samples, results, work);
  for (std::size_t i = 0; i < samples.size(); ++i) results[i].radiance = work.radiance[i];
}

void WaveRenderer::camera_wave(std::span<const PixelSample> samples,
                               std::span<SampleResult> results, Workspace& work) const {
  const Film& film = scene_.film;
  const std::size_t count = samples.size();
  Wave& wave = work.new_wave(0, Wave::Kind::kCamera);
  wave.count = count;
  wave.left = plan_.depth;
  wave.branch = 0;
  const bool lens = plan_.on<effects::DepthOfField>();
  const WaveKernels& kernels = wave_kernels();
  for (std::size_t i = 0; i < count; ++i) {
    const PixelSample& s = samples[i];
    const FilterSampler::Place place = filter_.place(s.index);
    const std::uint32_t pixel = sobol::pixel_hash(
        std::uint64_t(s.y) * std::uint64_t(film.width) + std::uint64_t(s.x), scene_.sampler.seed);
    // The filter's parts have a sequence each.
    work.pixel[i] = place.negative ? sobol::hash(pixel) : pixel;
    work.index[i] = place.index;
    work.radiance[i] = {};
    wave.slot[i] = int(i);
    wave.weight[i] = {1, 1, 1};
    wave.leaves[i] = -1;
    results[i].negative = place.negative;
    put(frame_.origin, wave.origin, i);
  }
  if (scene_.sampler.sample_count == 1) {
    for (std::size_t i = 0; i < count; ++i) {
      work.u[i] = frame_.film_u(samples[i].x + 0.5);
      work.v[i] = frame_.film_v(samples[i].y + 0.5);
    }
  } else {
    kernels.random(count, work.pixel.data(), work.index.data(), 0, work.u, work.v);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [x, y] = filter_(results[i].negative, work.u[i], work.v[i]);
      work.u[i] = frame_.film_u(samples[i].x + (0.5 + x));
      work.v[i] = frame_.film_v(samples[i].y + (0.5 + y));
    }
  }
  if (lens) {
    kernels.random(count, work.pixel.data(), work.index.data(), 1, work.lens_u, work.lens_v);
    for (std::size_t i = 0; i < count; ++i) {
      // A point of the disc, evenly by area.
      const double radius = scene_.camera.aperture_radius * std::sqrt(work.lens_u[i]);
      const double turn = 2 * std::numbers::pi * work.lens_v[i];
      const double x = radius * std::cos(turn), y = radius * std::sin(turn);
      put(frame_.origin + x * frame_.right + y * frame_.up, wave.origin, i);
      work.lens_u[i] = x / scene_.camera.focus_distance;
      work.lens_v[i] = y / scene_.camera.focus_distance;
    }
  } else {
    std::fill_n(work.lens_u, count, 0.0);
    std::fill_n(work.lens_v, count, 0.0);
  }
  kernels.camera_rays(frame_, count, work.u, work.v, work.lens_u, work.lens_v, wave.to_eye);
  work.work.camera_rays += count;
  if (lens) work.work.of<effects::DepthOfField>() += count;
  for (const PixelSample& s : samples)
    if (s.index > 0) ++work.work.of<effects::Antialiasing>();
  follow(wave, work);
  for (std::size_t i = 0; i < count; ++i) results[i].surface = int(wave.surface[i]);
}

void WaveRenderer::follow(Wave& wave, Workspace& work) const {
  trace(wave, work);
  if (any_sized_) add_emitters(wave, work);
  if (wave.lights_only) return;
  // The waves that go on from here are filled while the groups are shaded.
  Wave& mirrored = work.new_wave(wave.level + 1, Wave::Kind::kMirror);
  Wave& scattered = work.new_wave(wave.level + 1, Wave::Kind::kScattered);
  mirrored.left = {wave.left.mirror - 1, wave.left.glossy};
  mirrored.lights_only = wave.left.mirror < 1;
  mirrored.branch = sobol::hash(wave.branch + 1);
  scattered.left = {wave.left.mirror, wave.left.glossy - 1};
  scattered.lights_only = wave.left.glossy < 1;
  scattered.branch = sobol::hash(wave.branch + 2);
  shade(wave, work);
  if (mirrored.count > 0) follow(mirrored, work);
  if (scattered.count > 0) follow(scattered, work);
}

/// What each ray meets, and where.
void WaveRenderer::trace(Wave& wave, Workspace& work) const {
  const std::size_t count = wave.count, spheres = scene_.spheres.size();
  if (accelerator_)
    for (std::size_t i = 0; i < count; ++i) {
      const auto hit =
          accelerator_->nearest(get(wave.origin, i), -get(wave.to_eye, i), int(wave.leaves[i]));
      wave.surface[i] = hit.sphere;
      wave.distance[i] = hit.sphere < 0 ? kInfinity : hit.distance;
    }
  else
    wave_kernels().nearest_sphere(scene_.spheres, count, wave.origin, wave.to_eye, wave.leaves,
                                  wave.surface, wave.distance);
  const WaveKernels& kernels = wave_kernels();
  for (std::size_t k = 0; k < scene_.planes.size(); ++k) {
    kernels.nearest_plane(scene_.planes[k], double(spheres + k), count, wave.origin, wave.to_eye,
                          wave.leaves, wave.surface, wave.distance);
    work.work.of<effects::Ground>() += count;
  }
  // Lanes that meet no sphere are computed too, with any sphere.
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const bool met = wave.surface[i] >= 0 && wave.surface[i] < double(spheres);
    any |= met;
    const Sphere& sphere = met ? scene_.spheres[std::size_t(wave.surface[i])] : kUnitSphere;
    put(sphere.center, work.center, i);
    work.radius[i] = sphere.radius;
  }
  if (any)
    kernels.surface(count, wave.origin, wave.to_eye, work.center, work.radius, wave.point,
                    wave.normal);
  for (std::size_t k = 0; k < scene_.planes.size(); ++k)
    kernels.plane_surface(scene_.planes[k], double(spheres + k), count, wave.origin, wave.to_eye,
                          wave.surface, wave.distance, wave.point, wave.normal);
}

/// The lights that rays cross on their way, or end in.
void WaveRenderer::add_emitters(Wave& wave, Workspace& work) const {
  const bool scattered = wave.kind == Wave::Kind::kScattered;
  for (std::size_t l = 0; l < scene_.lights.size(); ++l) {
    const Light& light = scene_.lights[l];
    if (is_delta(light) || (is_black(strength(light)) && plan_.policy != EffectPolicy::kAll))
      continue;
    const Environment* environment = environments_[l].get();
    const bool on_surface = !plan_.contacts[l].empty();
    if (!environment) {
      if (rectangles_[l])
        light_kernels().meet_rectangle(*rectangles_[l], wave.count, wave.origin, wave.to_eye,
                                       scattered, work.met);
      else
        light_kernels().meet_sphere(std::get<SphereLight>(light), wave.count, wave.origin,
                                    wave.to_eye, scattered, work.met);
      work.work.of<effects::AreaLights>() += wave.count;
    }
    for (std::size_t i = 0; i < wave.count; ++i) {
      if (!environment && !(work.met.distance[i] < kInfinity)) continue;
      bool hidden = environment ? wave.surface[i] >= 0 : !(work.met.distance[i] < wave.distance[i]);
      if (on_surface) {
        if (plan_.lies_on(l, int(wave.leaves[i]))) continue;
        hidden &= !plan_.lies_on(l, int(wave.surface[i]));
      }
      if (hidden && (plan_.experiment.shadows || !scattered)) continue;
      const LightStrategy strategy =
          scattered ? plan_.strategy[l][std::size_t(wave.material[i])] : LightStrategy::kSurface;
      if (strategy == LightStrategy::kLight) continue;
      Rgb radiance = strength(light);
      double pdf = 0;
      if (environment) {
        const Environment::Look seen = environment->look(-get(wave.to_eye, i));
        radiance = seen.radiance;
        pdf = seen.pdf;
        ++work.work.of<effects::Environment>();
      } else if (scattered) {
        pdf = work.met.pdf[i];
      }
      const double share = strategy == LightStrategy::kBoth ? power_heuristic(wave.pdf[i], pdf) : 1;
      Rgb& sum = work.radiance[std::size_t(wave.slot[i])];
      sum = sum + share * radiance * wave.weight[i];
    }
  }
}

/// Group by group, so that the material, and where surfaces are few also what may shadow them, are the
/// same for a whole run of lanes.
void WaveRenderer::shade(Wave& wave, Workspace& work) const {
  const int spheres = int(scene_.spheres.size());
  // A key for each hit: surface and material, or the material alone; and the few that there are.
  const int materials = int(materials_.size());
  std::array<int, kChunk> group_of;
  std::vector<int>& keys = work.keys;
  keys.clear();
  work.group_size.clear();
  std::size_t last = 0;
  for (std::size_t i = 0; i < wave.count; ++i) {
    group_of[i] = -1;
    const int surface = int(wave.surface[i]);
    if (surface < 0) continue;
    int material = 0;
    if (surface < spheres) {
      material = scene_.spheres[std::size_t(surface)].material;
    } else {
      const std::size_t k = std::size_t(surface - spheres);
      const Plane& plane = scene_.planes[k];
      material = plane.material;
      if (plane.checker_material != plane.material) {
        const Vec3 from = get(wave.point, i) - plane.point;
        const double half_square = 0.5 * (std::floor(dot(from, plane_u_[k]) / plane.checker_size) +
                                          std::floor(dot(from, plane_v_[k]) / plane.checker_size));
        if (half_square != std::floor(half_square)) material = plane.checker_material;
      }
    }
    const int key = one_by_one_ ? surface * materials + material : material;
    if (last >= keys.size() || keys[last] != key) {
      last = std::size_t(std::find(keys.begin(), keys.end(), key) - keys.begin());
      if (last == keys.size()) {
        keys.push_back(key);
        work.group_size.push_back(0);
      }
    }
    group_of[i] = int(last);
    ++work.group_size[last];
  }
  // The lanes of each group, one group after the other.
  std::vector<std::size_t>& begin = work.group_begin;
  begin.assign(keys.size() + 1, 0);
  for (std::size_t g = 0; g < keys.size(); ++g) begin[g + 1] = begin[g] + work.group_size[g];
  std::array<int, kChunk> lanes;
  std::vector<std::size_t>& next = work.group_next;
  next.assign(begin.begin(), begin.end());
  for (std::size_t i = 0; i < wave.count; ++i)
    if (group_of[i] >= 0) lanes[next[std::size_t(group_of[i])]++] = int(i);
  for (std::size_t g = 0; g < keys.size(); ++g) {
    const std::size_t hits = work.group_size[g];
    for (std::size_t j = 0; j < hits; ++j) {
      const std::size_t i = std::size_t(lanes[begin[g] + j]);
      copy(wave.point, i, work.point, j);
      copy(wave.normal, i, work.normal, j);
      copy(wave.to_eye, i, work.to_eye, j);
      work.weight[j] = wave.weight[i];
      work.slot[j] = wave.slot[i];
      work.hit_pixel[j] = work.pixel[std::size_t(wave.slot[i])];
      work.hit_index[j] = work.index[std::size_t(wave.slot[i])];
      work.surface[j] = int(wave.surface[i]);
    }
    const int key = keys[g];
    shade_group(wave, {one_by_one_ ? key % materials : key, one_by_one_ ? key / materials : -1},
                hits, work);
  }
}

void WaveRenderer::shade_group(Wave& wave, Group group, std::size_t hits, Workspace& work) const {
  for (std::size_t l = 0; l < scene_.lights.size(); ++l)
    if (plan_.lies_on(l, group.surface))
      continue;
    else if (is_delta(scene_.lights[l]))
      light_delta(wave, group, l, hits, work);
    else if (plan_.strategy[l][std::size_t(group.material)] != LightStrategy::kSurface)
      light_sized(wave, group, l, hits, work);
  const PreparedMaterial& material = materials_[std::size_t(group.material)];
  const bool all = plan_.policy == EffectPolicy::kAll;
  const bool is_mirror = all || !is_black(material.material.mirror_reflectance);
  const bool mirrors = is_mirror && plan_.on<effects::Mirror>() &&
                       (wave.left.mirror > 0 || any_sized_ || (all && wave.level == 0));
  const bool scatters =
      wave.left.glossy > 0 || material.scatters_to_light || (all && wave.level == 0);
  const bool one_of_two = wave.level > 0 && mirrors && wave.left.glossy > 0;
  if (mirrors) spawn_mirror(wave, group, one_of_two, hits, work);
  if (scatters) spawn_scattered(wave, group, one_of_two, hits, work);
}

/// Takes from `falloff` what is hidden from the light.
void WaveRenderer::find_visible(std::size_t light, Group group, std::size_t hits,
                                Workspace& work) const {
  std::size_t rays = 0;
  if (group.surface >= 0) {
    const Occluders& occluders = plan_.occluders_of(light, std::size_t(group.surface));
    if (occluders.empty()) return;
    rays = hits;
    if (occluders.spheres.empty())
      std::fill_n(work.visible, hits, 1.0);
    else
      kernels_.visibility(scene_.spheres, occluders.spheres, hits, work.point, work.to_light,
                          work.distance, work.visible);
    for (const int k : occluders.planes)
      wave_kernels().plane_hides(scene_.planes[std::size_t(k)], hits, work.point, work.to_light,
                                 work.distance, work.visible);
    work.work.of<effects::Ground>() += hits * occluders.planes.size();
    for (const Horizon& horizon : occluders.horizons)
      for (std::size_t i = 0; i < hits; ++i)
        if (horizon.is_below(get(work.point, i))) work.visible[i] = 0;
    for (std::size_t i = 0; i < hits; ++i) work.falloff[i] *= work.visible[i];
  } else {
    for (std::size_t i = 0; i < hits; ++i) {
      const int surface = work.surface[i];
      const Occluders& occluders = plan_.occluders_of(light, std::size_t(surface));
      const Vec3 point = get(work.point, i);
      if (plan_.lies_on(light, surface) ||
          std::ranges::any_of(occluders.horizons,
                              [&](const Horizon& h) { return h.is_below(point); }))
        work.falloff[i] = 0;
      if (occluders.empty()) continue;
      ++rays;
      if (accelerator_->blocked(point, get(work.to_light, i), work.distance[i], surface,
                                plan_.contacts[light]))
        work.falloff[i] = 0;
    }
    hide_behind_planes(light, hits, work);
  }
  work.work.shadow_rays += rays;
  work.work.of<effects::Shadows>() += rays;
}

/// Of hits on any surface.
void WaveRenderer::hide_behind_planes(std::size_t light, std::size_t hits, Workspace& work) const {
  for (std::size_t k = 0; k < scene_.planes.size(); ++k) {
    const int own = int(scene_.spheres.size() + k);
    if (plan_.lies_on(light, own)) continue;
    std::fill_n(work.visible, hits, 1.0);
    wave_kernels().plane_hides(scene_.planes[k], hits, work.point, work.to_light, work.distance,
                               work.visible);
    for (std::size_t i = 0; i < hits; ++i)
      if (work.surface[i] != own) work.falloff[i] *= work.visible[i];
    work.work.of<effects::Ground>() += hits;
  }
}

void WaveRenderer::light_delta(const Wave& wave, Group group, std::size_t light, std::size_t hits,
                               Workspace& work) const {
  kernels_.light(scene_.lights[light], hits, work.point, work.to_light, work.falloff,
                 work.distance);
  find_visible(light, group, hits, work);
  const auto& row = plan_.precision[light];
  const bool as_seen =
      wave.level == 0 && group.surface >= 0 && std::size_t(group.surface) < row.size();
  add_light(group,
            as_seen ? row[std::size_t(group.surface)]
                    : plan_.any_direction_precision[std::size_t(group.material)],
            strength(scene_.lights[light]), nullptr, hits, work);
}

void WaveRenderer::light_sized(const Wave& wave, Group group, std::size_t light, std::size_t hits,
                               Workspace& work) const {
  const Rgb emitted = strength(scene_.lights[light]);
  if (is_black(emitted) && plan_.policy != EffectPolicy::kAll) return;
  const Environment* environment = environments_[light].get();
  const bool both = plan_.strategy[light][std::size_t(group.material)] == LightStrategy::kBoth;
  const Reflector& reflector = materials_[std::size_t(group.material)].reflector;
  work.draw(wave, hits, kLightDimension + std::uint32_t(light));
  sample_light(light, hits, work);
  if (both)
    for (std::size_t i = 0; i < hits; ++i) {
      const Vec3 normal = get(work.normal, i), to_light = get(work.to_light, i);
      if (work.falloff[i] > 0 && dot(normal, to_light) > 0)
        work.falloff[i] *= power_heuristic(
            1 / work.falloff[i], reflector.pdf_above({normal, get(work.to_eye, i), to_light}));
    }
  (environment ? work.work.of<effects::Environment>() : work.work.of<effects::AreaLights>()) +=
      hits;
  find_visible(light, group, hits, work);
  add_light(group, plan_.any_direction_precision[std::size_t(group.material)], emitted,
            environment && std::get<EnvironmentLight>(scene_.lights[light]).image ? work.tint.data()
                                                                                  : nullptr,
            hits, work);
}

/// Directions to a light with a size: to_light, distance, and falloff, the inverse of their density.
void WaveRenderer::sample_light(std::size_t light, std::size_t hits, Workspace& work) const {
  if (const Environment* environment = environments_[light].get()) {
    for (std::size_t i = 0; i < hits; ++i) {
      const LightSample drawn = environment->sample(work.random_u[i], work.random_v[i]);
      put(drawn.to_light, work.to_light, i);
      work.falloff[i] = drawn.pdf > 0 ? 1 / drawn.pdf : 0;  // a density may underflow
      work.distance[i] = kInfinity;
      work.tint[i] = drawn.radiance;
    }
    return;
  }
  if (rectangles_[light])
    light_kernels().sample_rectangle(*rectangles_[light], hits, work.point, work.random_u,
                                     work.random_v, work.drawn);
  else
    light_kernels().sample_sphere(std::get<SphereLight>(scene_.lights[light]), hits, work.point,
                                  work.random_u, work.random_v, work.drawn);
  for (std::size_t i = 0; i < hits; ++i) {
    const bool some = work.drawn.inverse_pdf[i] > 0;
    put(get(some ? work.drawn.to_light : work.normal, i), work.to_light, i);
    work.falloff[i] = some ? work.drawn.inverse_pdf[i] : 0;
    work.distance[i] = work.drawn.distance[i];
  }
}

/// What the surface makes of the light along `to_light`, times `falloff`: highlight, Fresnel, diffuse.
void WaveRenderer::add_light(Group group, Precision precision, Rgb emitted, const Rgb* tints,
                             std::size_t hits, Workspace& work) const {
  const PreparedMaterial& material = materials_[std::size_t(group.material)];
  const Highlight& highlight = material.material.highlight;
  const auto add = [&](std::size_t i, double factor, Rgb reflectance, Rgb constant) {
    Rgb& sum = work.radiance[std::size_t(work.slot[i])];
    sum = sum + factor * (tints ? reflectance * tints[i] : constant) * work.weight[i];
  };
  const bool all = plan_.policy == EffectPolicy::kAll;
  if (all || has_highlight(material.material)) {
    kernels_.shade(highlight, precision)(highlight, hits, work.normal, work.to_eye, work.to_light,
                                         work.specular);
    const Rgb specular = emitted * material.specular;
    for (std::size_t i = 0; i < hits; ++i)
      add(i, work.falloff[i] * work.specular[i], material.specular, specular);
  }
  if (all || material.material.fresnel != Fresnel::kNone) {
    const Rgb grazing = emitted * material.grazing;
    kernels_.fresnel(hits, work.to_eye, work.to_light, work.fresnel);
    for (std::size_t i = 0; i < hits; ++i)
      add(i, work.falloff[i] * work.specular[i] * work.fresnel[i], material.grazing, grazing);
    work.work.of<effects::Fresnel>() += hits;
  }
  if (all || !is_black(material.material.diffuse_reflectance)) {
    const Rgb diffuse = emitted * material.diffuse;
    kernels_.cosine(hits, work.normal, work.to_light, work.n_dot_l);
    for (std::size_t i = 0; i < hits; ++i)
      add(i, work.falloff[i] * work.n_dot_l[i], material.diffuse, diffuse);
    work.work.of<effects::Diffuse>() += hits;
  }
}

void WaveRenderer::spawn_mirror(const Wave& wave, Group group, bool one_of_two, std::size_t hits,
                                Workspace& work) const {
  const Material& material = materials_[std::size_t(group.material)].material;
  Wave& next = work.wave_at(wave.level + 1, Wave::Kind::kMirror);
  const std::size_t before = next.count;
  const double at_grazing = mirror_at_grazing(material.mirror_reflectance);
  if (one_of_two) work.draw(wave, hits, kChoiceDimension);
  for (std::size_t i = 0; i < hits; ++i) {
    if (one_of_two && !takes_mirror(work.random_u[i])) continue;
    const Vec3 normal = get(work.normal, i), to_eye = get(work.to_eye, i);
    const double n_dot_v = dot(normal, to_eye);
    const Vec3 mirrored = normalize(2 * n_dot_v * normal - to_eye);
    const Rgb reflectance =
        fresnel_factor(material.fresnel, material.mirror_reflectance, to_eye, mirrored, at_grazing);
    const std::size_t to = next.count++;
    copy(work.point, i, next.origin, to);
    put(-mirrored, next.to_eye, to);
    next.leaves[to] = work.surface[i];
    next.weight[to] = (one_of_two ? 2.0 : 1.0) * work.weight[i] * reflectance;
    next.slot[to] = work.slot[i];
  }
  work.work.mirror_rays += next.count - before;
  work.work.of<effects::Mirror>() += next.count - before;
}

void WaveRenderer::spawn_scattered(const Wave& wave, Group group, bool one_of_two, std::size_t hits,
                                   Workspace& work) const {
  const PreparedMaterial& material = materials_[std::size_t(group.material)];
  const bool highlight = has_highlight(material.material);
  const bool even = plan_.experiment.directions == Experiment::Directions::kEven;
  const bool roulette = wave.level >= kRouletteFrom;
  Wave& next = work.wave_at(wave.level + 1, Wave::Kind::kScattered);
  // Forced though nothing calls for it: the rays are traced and bring nothing.
  const bool forced = wave.left.glossy < 1 && !material.scatters_to_light;
  const std::size_t before = next.count;
  std::array<bool, kChunk> skipped{};
  if (one_of_two) {
    work.draw(wave, hits, kChoiceDimension);
    for (std::size_t i = 0; i < hits; ++i) skipped[i] = takes_mirror(work.random_u[i]);
  }
  std::array<double, kChunk> choice, chance;  // between highlight and base; to go on
  if (highlight || roulette) {
    work.draw(wave, hits, kScatterDimension);
    std::copy_n(work.random_u, hits, choice.begin());
    std::copy_n(work.random_v, hits, chance.begin());
  }
  work.draw(wave, hits, kDirectionDimension);
  if (!highlight && !even)
    wave_kernels().scatter_evenly(hits, work.normal, work.random_u, work.random_v, work.to_light);
  for (std::size_t i = 0; i < hits; ++i) {
    if (skipped[i]) continue;
    const Vec3 normal = get(work.normal, i);
    std::optional<ReflectorSample> drawn;
    if (even) {
      const Vec3 to_light = about(normal, work.random_u[i], work.random_v[i]);
      drawn = {to_light, material.reflector.eval(normal, get(work.to_eye, i), to_light),
               std::numbers::inv_pi / 2};
    } else if (highlight) {
      drawn = material.reflector.sample_above(normal, get(work.to_eye, i), choice[i],
                                              work.random_u[i], work.random_v[i]);
    } else {
      const Vec3 to_light = get(work.to_light, i);
      const double cosine = dot(normal, to_light);
      if (cosine > 0) drawn = {to_light, cosine * material.diffuse, cosine * std::numbers::inv_pi};
    }
    if (!drawn) continue;
    Rgb weight = (forced       ? 0.0
                  : one_of_two ? 2 / drawn->pdf
                               : 1 / drawn->pdf) *
                 work.weight[i] * drawn->radiance;
    if (roulette) {
      const double survival = std::min(1.0, max_component(weight));
      if (!(chance[i] < survival)) continue;
      weight = 1 / survival * weight;
    }
    const std::size_t to = next.count++;
    copy(work.point, i, next.origin, to);
    put(-drawn->to_light, next.to_eye, to);
    next.leaves[to] = work.surface[i];
    next.weight[to] = weight;
    next.slot[to] = work.slot[i];
    next.pdf[to] = drawn->pdf;
    next.material[to] = group.material;
  }
  work.work.scattered_rays += next.count - before;
  if (wave.left.glossy > 0 || forced) work.work.of<effects::Glossy>() += next.count - before;
}

}  // namespace lobelia
