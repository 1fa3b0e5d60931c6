// The plan: which effects a scene calls for, and why. Nothing else is simulated.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia {

enum class EffectPolicy { kAsCalledFor, kAll };

struct EffectDecision {
  std::string name;  ///< "shadows"
  bool on = false;
  std::string
      reason;  ///< in words: "one sphere; a convex body cannot shadow itself beyond N.L <= 0"
};

struct Plan {
  std::vector<EffectDecision> effects;
  /// occluders[light][sphere]: the spheres that may stand between that sphere and that light.
  std::vector<std::vector<std::vector<int>>> occluders;
  bool diffuse = false;               ///< some lit material has a diffuse base
  std::uint64_t camera_rays = 0;      ///< exactly
  std::uint64_t max_shadow_rays = 0;  ///< at most: one per lit hit and light with occluders
};

Plan make_plan(const Scene& scene, EffectPolicy policy);

}  // namespace lobelia
