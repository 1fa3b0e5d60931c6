// Light that highlights and diffuse bases throw on other surfaces.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct Glossy {
  static constexpr std::string_view kName = "glossy", kWork = "scattered rays",
                                    kHides = "a rare path may be missed by all of a few samples";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan& plan) {
    const bool all = policy == EffectPolicy::kAll;
    plan.depth.glossy = scene.depth.glossy;
    if (scene.spheres.size() + scene.planes.size() < 2)
      return {all, "one convex body throws no light on itself"};
    if (scene.depth.glossy == 0)
      return {all, "no inter-reflection was asked for (glossy_depth is 0)"};
    const auto lamps = std::ranges::count_if(scene.lights, is_delta);
    plan.draws_lamp = !plan.experiment.sum_all_lights && lamps > std::ptrdiff_t(kMaxSummedLights);
    return {true,
            fmt::format("inter-reflection was asked for, up to {} times{}", scene.depth.glossy,
                        plan.draws_lamp
                            ? fmt::format("; after the first surface, each point draws one of {} "
                                          "lights without a size, by power and distance",
                                          lamps)
                            : "")};
  }
};

}  // namespace lobelia::effects
