// Perfect mirrors: one ray for each hit, nothing random.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct Mirror {
  static constexpr std::string_view kName = "mirror", kWork = "mirror rays",
                                    kHides = "what a mirror shows may be of any size";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan& plan) {
    plan.depth.mirror = scene.depth.mirror;
    const auto mirrors = std::ranges::count_if(scene.materials, is_mirror);
    const bool sized_light = !std::ranges::all_of(scene.lights, is_delta);
    const bool surfaces = scene.spheres.size() + scene.planes.size() > 1;
    if (policy == EffectPolicy::kAll) return {true, fmt::format("{} mirrors", mirrors)};
    if (mirrors == 0) return {false, "no material is a mirror"};
    if (sized_light) return {true, "a light with a size is seen in a mirror"};
    // A ray never meets a delta light: a mirror cannot show it.
    if (!surfaces) return {false, "one convex body: there is nothing to be mirrored"};
    if (scene.depth.mirror == 0) return {false, "a mirror_depth of 0 was asked for"};
    return {true, fmt::format("{} of {} materials are mirrors, followed up to {} times", mirrors,
                              scene.materials.size(), scene.depth.mirror)};
  }
};

}  // namespace lobelia::effects
