// Light from everywhere, seen where there is no surface.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct Environment {
  static constexpr std::string_view kName = "environment", kWork = "directions",
                                    kHides =
                                        "a bright spot of it may be missed by all of a few samples";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan&) {
    std::size_t constant = 0, images = 0;
    for (const Light& light : scene.lights) {
      if (!is_environment(light) || is_black(strength(light))) continue;
      ++(info(light).varies ? images : constant);
    }
    const bool on = constant + images > 0;
    return {policy == EffectPolicy::kAll || on,
            on ? fmt::format("{} of one radiance, {} with an image", constant, images)
               : "no light comes from everywhere"};
  }
};

}  // namespace lobelia::effects
