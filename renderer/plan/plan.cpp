#include "renderer/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

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

EffectDecision decide_fresnel(const Scene& scene, EffectPolicy policy, Plan& plan) {
  const auto reflecting =
      std::count_if(scene.materials.begin(), scene.materials.end(),
                    [](const Material& m) { return m.fresnel != Fresnel::kNone; });
  plan.fresnel = policy == EffectPolicy::kAll || reflecting > 0;
  std::string reason = reflecting > 0 ? fmt::format("{} of {} materials have a Fresnel factor",
                                                    reflecting, scene.materials.size())
                                      : "no material has a Fresnel factor";
  return {"fresnel", plan.fresnel, std::move(reason)};
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

/// A lower bound of |L + V| over the points of a sphere that are seen and lit: from the centre's
/// directions, each widened by the angle that the sphere fills. 0 where there is none.
double min_half_length(const Scene& scene, const Light& light, const Sphere& sphere) {
  const auto widening = [&](Vec3 from) {
    const double distance = length(from - sphere.center);
    return distance > sphere.radius ? std::asin(sphere.radius / distance) : std::numbers::pi;
  };
  const Vec3 to_eye = scene.camera.origin - sphere.center;
  if (length(to_eye) == 0) return 0;
  double angle = widening(scene.camera.origin);
  Vec3 to_light;
  if (const auto* directional = std::get_if<DirectionalLight>(&light)) {
    to_light = -directional->direction;
  } else {
    const Vec3 position = std::get<PointLight>(light).position;
    angle += widening(position);
    to_light = position - sphere.center;
    if (length(to_light) == 0) return 0;
  }
  angle += std::acos(std::clamp(dot(normalize(to_eye), normalize(to_light)), -1.0, 1.0));
  return angle < std::numbers::pi ? 2 * std::cos(angle / 2) : 0;
}

void decide_precision(const Scene& scene, std::optional<Precision> asked, Plan& plan) {
  std::array<std::size_t, 3> pairs{};
  // For each material by the length of L + V, rounded down to a power of 2^(1/4): a crowd of spheres
  // then asks for few bounds.
  std::map<std::pair<int, int>, Precision> known;
  for (const Light& light : scene.lights) {
    auto& row = plan.precision.emplace_back();
    for (const Sphere& sphere : scene.spheres) {
      Precision precision = asked.value_or(Precision::kFloat64);
      if (!asked) {
        const double least = min_half_length(scene, light, sphere);
        constexpr int kShortest = -32;
        const int quarters =
            least > 0 ? std::max(kShortest, int(std::floor(4 * std::log2(least)))) : kShortest;
        const auto [entry, is_new] = known.try_emplace({sphere.material, quarters});
        if (is_new)
          entry->second =
              sufficient_precision(scene.materials[sphere.material].highlight,
                                   quarters > kShortest ? std::exp2(quarters / 4.0) : 0);
        precision = entry->second;
      }
      row.push_back(precision);
      ++pairs[std::size_t(precision)];
    }
  }
  if (asked) {
    plan.precision_reason = fmt::format("{} was asked for", name(*asked));
    return;
  }
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (pairs[p] > 0)
      plan.precision_reason += fmt::format(
          "{}{} for {} of {} pairs of light and sphere", plan.precision_reason.empty() ? "" : ", ",
          name(Precision(p)), pairs[p], scene.lights.size() * scene.spheres.size());
  plan.precision_reason +=
      plan.precision_reason.empty()
          ? "nothing is lit"
          : fmt::format(": the narrowest that adds at most {:g} of the peak", kAllowedShadingError);
}

EffectDecision decide_antialiasing(const Scene& scene) {
  const int samples = scene.sampler.sample_count;
  return {"antialiasing", samples > 1,
          samples > 1 ? fmt::format("{} rays a pixel were asked for", samples)
                      : "one ray a pixel, through its centre"};
}

}  // namespace

Plan make_plan(const Scene& scene, EffectPolicy policy, std::optional<Precision> precision) {
  Plan plan;
  plan.effects.push_back(decide_diffuse(scene, policy, plan));
  plan.effects.push_back(decide_fresnel(scene, policy, plan));
  plan.effects.push_back(decide_shadows(scene, policy, plan));
  plan.effects.push_back(decide_antialiasing(scene));
  if (policy == EffectPolicy::kAll)
    for (auto& effect : plan.effects)
      if (effect.on) effect.reason += " (forced: all effects were asked for)";
  decide_precision(scene, precision, plan);
  plan.camera_rays = product(scene.film, scene.sampler);
  for (const auto& by_sphere : plan.occluders)
    if (std::any_of(by_sphere.begin(), by_sphere.end(), [](const auto& o) { return !o.empty(); }))
      plan.max_shadow_rays += plan.camera_rays;
  return plan;
}

}  // namespace lobelia
