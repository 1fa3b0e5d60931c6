#include "renderer/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lobelia {
namespace {

/// Whether `occluder` can stand between any point of `receiver` and the light. Conservative: false
/// only where the sphere of radius rA + rB around the occluder stays clear of the axis from the
/// receiver's centre to the light.
bool may_occlude(const Light& light, const Sphere& receiver, const Sphere& occluder) {
  const Vec3 to_occluder = occluder.center - receiver.center;
  const double reach = receiver.radius + occluder.radius;
  Vec3 axis;
  double axis_length = std::numeric_limits<double>::infinity();
  if (const auto* directional = std::get_if<DirectionalLight>(&light)) {
    axis = -directional->direction;
  } else {
    const Vec3 way = std::get<PointLight>(light).position - receiver.center;
    axis_length = length(way);
    if (axis_length <= receiver.radius) return true;  // the light is inside: rule nothing out
    axis = normalize(way);
  }
  const double along = std::clamp(dot(to_occluder, axis), 0.0, axis_length);
  // A hair wider than the geometry, so that rounding never rules out a grazing occluder.
  return length(to_occluder - along * axis) <= reach * (1 + 1e-9);
}

std::uint64_t product(const Film& film, const Sampler& sampler) {
  return std::uint64_t(film.width) * film.height * sampler.sample_count;
}

EffectDecision decide_diffuse(const Scene& scene, EffectPolicy policy, Plan& plan) {
  const auto lambertian =
      std::count_if(scene.materials.begin(), scene.materials.end(),
                    [](const Material& m) { return !is_black(m.diffuse_reflectance); });
  plan.diffuse = policy == EffectPolicy::kAll || lambertian > 0;
  std::string reason = lambertian > 0 ? fmt::format("{} of {} materials have a diffuse reflectance",
                                                    lambertian, scene.materials.size())
                                      : "no material has a diffuse reflectance";
  return {"diffuse", plan.diffuse, std::move(reason)};
}

EffectDecision decide_shadows(const Scene& scene, EffectPolicy policy, Plan& plan) {
  std::size_t pairs = 0;
  plan.occluders.assign(scene.lights.size(), std::vector<std::vector<int>>(scene.spheres.size()));
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    if (is_black(strength(scene.lights[l])) && policy != EffectPolicy::kAll) continue;
    for (std::size_t a = 0; a < scene.spheres.size(); ++a)
      for (std::size_t b = 0; b < scene.spheres.size(); ++b) {
        if (a == b) continue;  // a convex body shadows itself only where N.L <= 0
        if (policy != EffectPolicy::kAll &&
            !may_occlude(scene.lights[l], scene.spheres[a], scene.spheres[b]))
          continue;
        plan.occluders[l][a].push_back(int(b));
        ++pairs;
      }
  }
  const bool on = pairs > 0;
  std::string reason;
  if (scene.lights.empty())
    reason = "there is no light";
  else if (scene.spheres.size() < 2)
    reason = "one convex body shadows itself only where N.L <= 0, which every model knows";
  else if (on)
    reason = fmt::format("{} pairs of a sphere and a sphere that may stand between it and a light",
                         pairs);
  else
    reason = "no sphere can stand between another one and a light";
  return {"shadows", on, std::move(reason)};
}

EffectDecision decide_antialiasing(const Scene& scene) {
  const int samples = scene.sampler.sample_count;
  return {"antialiasing", samples > 1,
          samples > 1 ? fmt::format("{} rays a pixel were asked for", samples)
                      : "one ray a pixel, through its centre"};
}

}  // namespace

Plan make_plan(const Scene& scene, EffectPolicy policy) {
  Plan plan;
  plan.effects.push_back(decide_diffuse(scene, policy, plan));
  plan.effects.push_back(decide_shadows(scene, policy, plan));
  plan.effects.push_back(decide_antialiasing(scene));
  if (policy == EffectPolicy::kAll)
    for (auto& effect : plan.effects)
      if (effect.on) effect.reason += " (forced: all effects were asked for)";
  plan.camera_rays = product(scene.film, scene.sampler);
  for (const auto& by_sphere : plan.occluders)
    if (std::any_of(by_sphere.begin(), by_sphere.end(), [](const auto& o) { return !o.empty(); }))
      plan.max_shadow_rays += plan.camera_rays;
  return plan;
}

}  // namespace lobelia
