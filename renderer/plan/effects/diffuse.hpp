// The Lambertian base beneath a highlight.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct Diffuse {
  static constexpr std::string_view kName = "diffuse", kWork = "evaluations", kHides = "";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan&) {
    const auto lambertian = std::ranges::count_if(
        scene.materials, [](const Material& m) { return !is_black(m.diffuse_reflectance); });
    return {policy == EffectPolicy::kAll || lambertian > 0,
            lambertian > 0 ? fmt::format("{} of {} materials have a diffuse reflectance",
                                         lambertian, scene.materials.size())
                           : "no material has a diffuse reflectance"};
  }
};

}  // namespace lobelia::effects
