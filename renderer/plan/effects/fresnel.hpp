// Schlick's Fresnel factor on highlights and mirrors.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct Fresnel {
  static constexpr std::string_view kName = "fresnel", kWork = "evaluations", kHides = "";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan&) {
    const auto reflecting = std::ranges::count_if(
        scene.materials, [](const Material& m) { return m.fresnel != lobelia::Fresnel::kNone; });
    return {policy == EffectPolicy::kAll || reflecting > 0,
            reflecting > 0 ? fmt::format("{} of {} materials have a Fresnel factor", reflecting,
                                         scene.materials.size())
                           : "no material has a Fresnel factor"};
  }
};

}  // namespace lobelia::effects
