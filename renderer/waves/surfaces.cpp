
#include "renderer/chord.hpp"
#include "renderer/waves/waves.hpp"

namespace lobelia::waves {
namespace {

/// False if nothing can hide the light.
bool hide_one_surface(const PreparedScene& prepared, std::size_t light, Workspace& work) {
  const Hits& hits = work.hits;
  const Occluders& occluders = prepared.plan.occluders_of(light, std::size_t(hits.one_surface));
  if (occluders.empty()) return false;
  const LightSamples& drawn = work.drawn;
  if (occluders.spheres.empty())
    std::fill_n(work.visible, hits.count, 1.0);
  else
    kernels().visibility(prepared.scene.spheres, occluders.spheres, hits.count, hits.point,
                         drawn.to_light, drawn.distance, work.visible);
  for (const int k : occluders.planes)
    kernels().plane_hides(prepared.scene.planes[std::size_t(k)], hits.count, hits.point,
                          drawn.to_light, drawn.distance, work.visible);
  work.work.of<effects::Ground>() += hits.count * occluders.planes.size();
  for (const Horizon& horizon : occluders.horizons)
    for (std::size_t i = 0; i < hits.count; ++i)
      if (horizon.is_below(get(hits.point, i))) work.visible[i] = 0;
  for (std::size_t i = 0; i < hits.count; ++i) work.drawn.factor[i] *= work.visible[i];
  return true;
}

void hide_behind_planes(const PreparedScene& prepared, std::size_t light, Workspace& work) {
  const Hits& hits = work.hits;
  for (std::size_t k = 0; k < prepared.scene.planes.size(); ++k) {
    const int own = int(prepared.scene.spheres.size() + k);
    if (prepared.plan.lies_on(light, own)) continue;
    std::fill_n(work.visible, hits.count, 1.0);
    kernels().plane_hides(prepared.scene.planes[k], hits.count, hits.point, work.drawn.to_light,
                          work.drawn.distance, work.visible);
    for (std::size_t i = 0; i < hits.count; ++i)
      if (hits.surface[i] != own) work.drawn.factor[i] *= work.visible[i];
    work.work.of<effects::Ground>() += hits.count;
  }
}

/// For hits that each have a light of their own.
void hide_chosen_behind_planes(const PreparedScene& prepared, Workspace& work) {
  const Hits& hits = work.hits;
  for (std::size_t k = 0; k < prepared.scene.planes.size(); ++k) {
    const int own = int(prepared.scene.spheres.size() + k);
    std::fill_n(work.visible, hits.count, 1.0);
    kernels().plane_hides(prepared.scene.planes[k], hits.count, hits.point, work.drawn.to_light,
                          work.drawn.distance, work.visible);
    for (std::size_t i = 0; i < hits.count; ++i)
      if (const int light = work.chosen[i].light;
          light >= 0 && hits.surface[i] != own && !prepared.plan.lies_on(std::size_t(light), own))
        work.drawn.factor[i] *= work.visible[i];
    work.work.of<effects::Ground>() += hits.count;
  }
}

/// It is dark inside a sphere. Only a camera in a sphere sees other surfaces there.
void darken_insides(const PreparedScene& prepared, Wave& wave) {
  for (const int k : prepared.around_camera) {
    const Sphere& sphere = prepared.scene.spheres[std::size_t(k)];
    for (std::size_t i = 0; i < wave.count; ++i)
      if (wave.surface[i] >= 0 && wave.surface[i] != k && is_inside(sphere, get(wave.point, i)))
        wave.weight[i] = {};
  }
}

/// Sets the hit's factor to 0 if a sphere or a horizon hides the light. Returns the number of shadow rays.
std::size_t hide_one_hit(const PreparedScene& prepared, std::size_t light, std::size_t hit,
                         Workspace& work) {
  LightSamples& drawn = work.drawn;
  const int surface = work.hits.surface[hit];
  const Occluders& occluders = prepared.plan.occluders_of(light, std::size_t(surface));
  const Vec3 point = get(work.hits.point, hit);
  if (prepared.plan.lies_on(light, surface) ||
      std::ranges::any_of(occluders.horizons, [&](const Horizon& h) { return h.is_below(point); }))
    drawn.factor[hit] = 0;
  if (occluders.empty()) return 0;
  if (prepared.accelerator &&
      prepared.accelerator->blocked(point, get(drawn.to_light, hit), drawn.distance[hit], surface,
                                    prepared.plan.contacts[light]))
    drawn.factor[hit] = 0;
  return 1;
}

/// Returns the number of shadow rays.
std::size_t hide_any_surface(const PreparedScene& prepared, std::size_t light, Workspace& work) {
  std::size_t rays = 0;
  for (std::size_t i = 0; i < work.hits.count; ++i) rays += hide_one_hit(prepared, light, i, work);
  hide_behind_planes(prepared, light, work);
  return rays;
}

}  // namespace

void trace(const PreparedScene& prepared, Wave& wave, Workspace& work) {
  static constexpr Sphere kAnySphere{};
  const std::size_t count = wave.count, spheres = prepared.scene.spheres.size();
  const KernelTable& table = kernels();
  if (prepared.accelerator)
    for (std::size_t i = 0; i < count; ++i) {
      const auto hit = prepared.accelerator->nearest(get(wave.origin, i), -get(wave.to_eye, i),
                                                     int(wave.leaves[i]));
      wave.surface[i] = hit.sphere;
      wave.distance[i] = hit.sphere < 0 ? std::numeric_limits<double>::infinity() : hit.distance;
    }
  else
    table.nearest_sphere(prepared.scene.spheres, count, wave.origin, wave.to_eye, wave.leaves,
                         wave.surface, wave.distance);
  for (std::size_t k = 0; k < prepared.scene.planes.size(); ++k) {
    table.nearest_plane(prepared.scene.planes[k], double(spheres + k), count, wave.origin,
                        wave.to_eye, wave.leaves, wave.surface, wave.distance);
    work.work.of<effects::Ground>() += count;
  }
  // The kernel also computes rays that meet no sphere.
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const bool met = wave.surface[i] >= 0 && wave.surface[i] < double(spheres);
    any |= met;
    const Sphere& sphere = met ? prepared.scene.spheres[std::size_t(wave.surface[i])] : kAnySphere;
    put(sphere.center, work.center, i);
    work.radius[i] = sphere.radius;
  }
  if (any)
    table.surface(count, wave.origin, wave.to_eye, work.center, work.radius, wave.point,
                  wave.normal);
  for (std::size_t k = 0; k < prepared.scene.planes.size(); ++k)
    table.plane_surface(prepared.scene.planes[k], double(spheres + k), count, wave.origin,
                        wave.to_eye, wave.surface, wave.distance, wave.point, wave.normal);
  if (wave.level == 0) darken_insides(prepared, wave);
}

int material_at(const PreparedScene& prepared, const Wave& wave, std::size_t ray) {
  const std::size_t surface = std::size_t(wave.surface[ray]);
  if (surface < prepared.scene.spheres.size()) return prepared.scene.spheres[surface].material;
  const std::size_t k = surface - prepared.scene.spheres.size();
  const Plane& plane = prepared.scene.planes[k];
  if (plane.checker_material == plane.material) return plane.material;
  const Tangents& checker = prepared.checkers[k];
  const Vec3 from = get(wave.point, ray) - plane.point;
  const double half_square = 0.5 * (std::floor(dot(from, checker.first) / plane.checker_size) +
                                    std::floor(dot(from, checker.second) / plane.checker_size));
  return half_square != std::floor(half_square) ? plane.checker_material : plane.material;
}

void hide_chosen(const PreparedScene& prepared, Workspace& work) {
  std::size_t rays = 0;
  for (std::size_t i = 0; i < work.hits.count; ++i)
    if (work.chosen[i].light >= 0)
      rays += hide_one_hit(prepared, std::size_t(work.chosen[i].light), i, work);
  if (prepared.plan.on<effects::Shadows>()) hide_chosen_behind_planes(prepared, work);
  work.work.shadow_rays += rays;
  work.work.of<effects::Shadows>() += rays;
}

void hide(const PreparedScene& prepared, std::size_t light, Workspace& work) {
  const std::size_t rays = work.hits.one_surface < 0 ? hide_any_surface(prepared, light, work)
                           : hide_one_surface(prepared, light, work) ? work.hits.count
                                                                     : 0;
  work.work.shadow_rays += rays;
  work.work.of<effects::Shadows>() += rays;
}

}  // namespace lobelia::waves
