// Infinite planes, plain or with a checker.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct Ground {
  static constexpr std::string_view kName = "ground", kWork = "tests of ray and plane",
                                    kHides = "a plane's detail has no smallest size";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan&) {
    const auto checkered = std::ranges::count_if(
        scene.planes, [](const Plane& p) { return p.material != p.checker_material; });
    const bool on = !scene.planes.empty();
    return {policy == EffectPolicy::kAll || on,
            on ? fmt::format("{} planes, {} with a checker", scene.planes.size(), checkered)
               : "there is no plane"};
  }
};

}  // namespace lobelia::effects
