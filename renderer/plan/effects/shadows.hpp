// Shadows: surfaces between a surface and a light.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct Shadows {
  static constexpr std::string_view kName = "shadows", kWork = "shadow rays", kHides = "";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan& plan) {
    plan.occluders = find_occluders(scene, plan.contacts, policy);
    std::size_t pairs = 0;
    bool uncounted = false;
    for (const auto& row : plan.occluders)
      for (const Occluders& o : row) {
        pairs += o.spheres.size() + o.planes.size() + o.horizons.size();
        uncounted |= o.any_sphere;
      }
    const bool on = uncounted || pairs > 0;
    if (scene.lights.empty()) return {on, "there is no light"};
    if (scene.spheres.size() + scene.planes.size() < 2)
      return {on, "one convex body shadows itself only where N.L <= 0, which every model knows"};
    if (uncounted)
      return {on, fmt::format(
                      "{} spheres under {} lights: too many to rule pairs of them out one by one",
                      scene.spheres.size(), scene.lights.size())};
    if (!on) return {on, "no surface can stand between another one and a light"};
    return {on,
            fmt::format("{} pairs of a surface and another that may stand between it and a light",
                        pairs)};
  }
};

}  // namespace lobelia::effects
