// The plan: which effects a scene calls for, and why. Nothing else is simulated.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/precision.hpp"
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
  bool diffuse = false;  ///< some lit material has a diffuse base
  bool fresnel = false;  ///< some material has a Fresnel factor
  /// precision[light][sphere]: how a highlight is shaded, and in words why.
  std::vector<std::vector<Precision>> precision;
  std::string precision_reason;
  std::uint64_t camera_rays = 0;      ///< exactly
  std::uint64_t max_shadow_rays = 0;  ///< at most: one per lit hit and light with occluders
};

/// `precision` for every highlight, or for each the narrowest whose error bound allows it. That all
/// effects are asked for does not change the precision: it is no effect of light.
Plan make_plan(const Scene& scene, EffectPolicy policy,
               std::optional<Precision> precision = std::nullopt);

}  // namespace lobelia
