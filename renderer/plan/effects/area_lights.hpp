// Lights with a size: soft shadows, soft highlights.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct AreaLights {
  static constexpr std::string_view kName = "area_lights", kWork = "light samples",
                                    kHides =
                                        "a shadow's edge may be missed by all of a few samples";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan& plan) {
    const auto lights = std::ranges::count_if(
        scene.lights, [](const Light& l) { return is_area(l) && !is_black(strength(l)); });
    plan.draws_area_light =
        !plan.experiment.sum_all_lights && lights > std::ptrdiff_t(kMaxSummedLights);
    return {policy == EffectPolicy::kAll || lights > 0,
            lights > 0 ? fmt::format("{} of {} lights have a size{}", lights, scene.lights.size(),
                                     plan.draws_area_light
                                         ? "; each point draws one of them, by power and distance"
                                         : "")
                       : "no light has a size"};
  }
};

}  // namespace lobelia::effects
