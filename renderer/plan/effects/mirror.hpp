// Perfect mirrors: one ray for each that is seen, nothing random.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct Mirror {
  static constexpr std::string_view kName = "mirror", kWork = "mirror rays",
                                    kHides = "what a mirror shows may be of any size";
  static constexpr std::string_view kWithout = "no mirrors";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan& plan) {
    plan.depth.mirror = scene.depth.mirror;
    const auto mirrors =
        std::count_if(scene.materials.begin(), scene.materials.end(),
                      [](const Material& m) { return !is_black(m.mirror_reflectance); });
    const bool sized_light = std::any_of(scene.lights.begin(), scene.lights.end(),
                                         [](const Light& l) { return !is_delta(l); });
    const bool surfaces = scene.spheres.size() + scene.planes.size() > 1;
    if (policy == EffectPolicy::kAll)
      return {kName, kWork, true, fmt::format("{} mirrors", mirrors)};
    if (mirrors == 0) return {kName, kWork, false, "no material is a mirror"};
    if (sized_light) return {kName, kWork, true, "a light with a size is seen in a mirror"};
    // A delta light is never met by a ray: its highlight is all that a surface shows of it.
    if (!surfaces) return {kName, kWork, false, "one convex body: there is nothing to be mirrored"};
    if (scene.depth.mirror == 0) return {kName, kWork, false, "a mirror_depth of 0 was asked for"};
    return {kName, kWork, true,
            fmt::format("{} of {} materials are mirrors, followed up to {} times", mirrors,
                        scene.materials.size(), scene.depth.mirror)};
  }

  static void leave_out(Scene& scene, Experiment&) {
    for (Material& m : scene.materials) m.mirror_reflectance = {};
  }
};

}  // namespace lobelia::effects
