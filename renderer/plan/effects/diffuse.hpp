// The Lambertian base beneath a highlight.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct Diffuse {
  static constexpr std::string_view kName = "diffuse", kWork = "evaluations", kHides = "";
  static constexpr std::string_view kWithout = "black beneath the highlights";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan&) {
    const auto lambertian = std::ranges::count_if(
        scene.materials, [](const Material& m) { return !is_black(m.diffuse_reflectance); });
    return {policy == EffectPolicy::kAll || lambertian > 0,
            lambertian > 0 ? fmt::format("{} of {} materials have a diffuse reflectance",
                                         lambertian, scene.materials.size())
                           : "no material has a diffuse reflectance"};
  }

  static void leave_out(Scene& scene, Experiment&) {
    for (Material& m : scene.materials) m.diffuse_reflectance = {};
  }
};

}  // namespace lobelia::effects
