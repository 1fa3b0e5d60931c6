// A lens with a size, which blurs everything outside its plane of focus.
#pragma once

#include <fmt/format.h>

#include "renderer/plan/plan.hpp"

namespace lobelia::effects {

struct DepthOfField {
  static constexpr std::string_view kName = "depth_of_field", kWork = "points of the lens",
                                    kHides = "a blurred spot may be missed by all of a few samples";

  static EffectDecision decide(const Scene& scene, EffectPolicy policy, Plan&) {
    const bool on = scene.camera.aperture_radius > 0;
    return {policy == EffectPolicy::kAll || on,
            on ? fmt::format("a lens of radius {:g}, sharp at {:g}", scene.camera.aperture_radius,
                             scene.camera.focus_distance)
               : "the camera is a pinhole"};
  }
};

}  // namespace lobelia::effects
