// The plan: which effects a scene calls for, and why. Nothing else is simulated.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/plan/effect.hpp"
#include "renderer/precision.hpp"
#include "renderer/scene/contact.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Up to so many spheres each pair of them and a light is looked at, to find who may shadow whom.
inline constexpr std::size_t kMaxPairwiseSpheres = 256;
/// Up to so many spheres a ray is tested against each; beyond, Embree sorts them.
inline constexpr std::size_t kMaxLoopSpheres = 24;

/// Pictures are made in squares of so many pixels.
inline constexpr int kTileSide = 32;

/// How directions to a light with a size are drawn.
enum class LightStrategy : std::uint8_t {
  kLight,    ///< the light: the surface scatters evenly
  kBoth,     ///< light and surface, weighted by the power heuristic (Veach 1997, section 9.2.4)
  kSurface,  ///< the surface: the light is the same from everywhere
};

/// Deviations from the best plan, to measure their effect. Only studies ask for them.
struct Experiment {
  /// How directions to lights with a size are drawn, and those of inter-reflection.
  enum class Directions : std::uint8_t {
    kPlanned,
    kLight,    ///< to lights: by the light alone
    kSurface,  ///< to lights: by the surface alone, as its highlight and its cosine are
    kEven,     ///< all: evenly over the hemisphere, without importance sampling of any kind
  };
  Directions directions = Directions::kPlanned;
  bool shadows = true;  ///< false: nothing stands between a surface and a light
};

/// The surfaces that may hide a light from a surface.
struct Occluders {
  bool any_sphere = false;   ///< too many to say which
  std::vector<int> spheres;  ///< else these
  std::vector<int> planes;
  std::vector<Horizon> horizons;  ///< of spheres that the light lies on
  bool empty() const {
    return !any_sphere && spheres.empty() && planes.empty() && horizons.empty();
  }
};

struct Plan {
  std::vector<EffectDecision> effects;  ///< in the order of the catalogue
  EffectPolicy policy = EffectPolicy::kAsCalledFor;
  Experiment experiment;

  /// A light neither lights a surface that it lies on nor is hidden by it, but for its horizon.
  Contacts contacts;
  bool lies_on(std::size_t light, int surface) const {
    const std::vector<int>& c = contacts[light];
    return !c.empty() && std::find(c.begin(), c.end(), surface) != c.end();
  }

  /// occluders[light][surface]: spheres first, then planes; or one entry for all (find_occluders).
  std::vector<std::vector<Occluders>> occluders;
  const Occluders& occluders_of(std::size_t light, std::size_t surface) const {
    return occluders[light][std::min(surface, occluders[light].size() - 1)];
  }
  /// strategy[light][material]; of no meaning where is_delta(light).
  std::vector<std::vector<LightStrategy>> strategy;

  /// precision[light][sphere]: how a highlight is shaded as the camera sees it, and in words why. Empty
  /// rows for lights with a size and beyond kMaxPairwiseSpheres: there any direction counts.
  std::vector<std::vector<Precision>> precision;
  /// By material, for every other direction of light and eye.
  std::vector<Precision> any_direction_precision;
  std::string precision_reason;

  int first_samples = 1;  ///< of each pixel; the rest only where these differ
  std::string sample_reason;
  Depth depth;         ///< of reflections that are traced
  std::string kernel;  ///< which inner loops, in words

  /// At most: where every pixel needs all its samples, with the first ones around tiles.
  std::uint64_t camera_rays = 0;
  /// At most.
  std::uint64_t max_shadow_rays = 0, max_mirror_rays = 0, max_scattered_rays = 0;

  template <class Effect>
  bool on() const;  ///< plan/effects/catalogue.hpp
};

/// `precision` for every highlight, or for each the narrowest whose error bound allows it. That all
/// effects are asked for does not change the precision: it is no effect of light.
Plan make_plan(const Scene& scene, EffectPolicy policy,
               std::optional<Precision> precision = std::nullopt, Experiment experiment = {});

/// By material, a lower bound of |L + V| wherever the camera sees it lit, which is what shading_error_bound()
/// asks for; 0 where nothing is known: on planes, in mirrors, through a lens, under lights with a size.
std::vector<double> min_half_lengths(const Scene& scene);

}  // namespace lobelia
