// The plan: which effects a scene calls for, and why. Nothing else is simulated.
#pragma once

#include <algorithm>
#include <concepts>

#include "renderer/precision.hpp"
#include "renderer/scene/contact.hpp"

namespace lobelia {

/// With more spheres, the plan does not look for the occluders of each.
inline constexpr std::size_t kMaxPairwiseSpheres = 256;
/// With more spheres, Embree finds the one that a ray meets.
inline constexpr std::size_t kMaxLoopSpheres = 24;
/// With more area lights, or more lights of a single direction, one of them may stand for all.
inline constexpr std::size_t kMaxSummedLights = 64;
/// Pictures are rendered in squares of this size, in pixels.
inline constexpr int kTileSide = 32;

enum class EffectPolicy { kAsCalledFor, kAll };

struct EffectDecision {
  bool on = false;
  std::string reason;  ///< in words: "no sphere can stand between another one and a light"
  // Set by the planner, from the effect's constants.
  std::string_view name = {};   ///< "shadows"
  std::string_view work = {};   ///< its cost, as counted in every record: "shadow rays"
  std::string_view hides = {};  ///< E::kHides
};

/// Who draws the directions to a light with a size.
enum class LightStrategy : std::uint8_t {
  kLight,    ///< the light: the surface scatters evenly
  kBoth,     ///< light and surface, weighted by the power heuristic (Veach 1997, section 9.2.4)
  kSurface,  ///< the surface: the light comes evenly from everywhere
};

/// Deviations from the best plan, to measure their effect. Only studies ask for them.
struct Experiment {
  /// How directions of inter-reflection, and to lights with a size, are drawn.
  enum class Directions : std::uint8_t {
    kPlanned,
    kLight,    ///< to lights: by the light alone
    kSurface,  ///< to lights: by the surface alone, following its highlight and its cosine
    kEven,     ///< all: evenly over the hemisphere, without importance sampling
  };
  Directions directions = Directions::kPlanned;
  bool sum_all_lights = false;  ///< true: no light stands for others, however many there are
};

/// The surfaces that may hide a light from a surface.
struct Occluders {
  bool any_sphere = false;   ///< there are too many to tell
  std::vector<int> spheres;  ///< otherwise
  std::vector<int> planes;
  std::vector<Horizon> horizons;  ///< of spheres that the light lies on
  bool empty() const {
    return !any_sphere && spheres.empty() && planes.empty() && horizons.empty();
  }
};

struct Plan {
  std::vector<EffectDecision> effects;  ///< in the catalogue's order
  EffectPolicy policy = EffectPolicy::kAsCalledFor;
  Experiment experiment;

  /// A surface that a light lies on is not lit by it, and hides it only below the horizon.
  Contacts contacts;
  bool lies_on(std::size_t light, int surface) const {
    return std::ranges::find(contacts[light], surface) != contacts[light].end();
  }

  /// As find_occluders().
  std::vector<std::vector<Occluders>> occluders;
  const Occluders& occluders_of(std::size_t light, std::size_t surface) const {
    return occluders[light][std::min(surface, occluders[light].size() - 1)];
  }
  /// Whether one area light is drawn at each point, with a probability that follows what it can bring; otherwise every
  /// one is sampled. The same for lights of a single direction, at points that a scattered ray has met; at others every
  /// one is summed, so that no noise comes from them.
  bool draws_area_light = false, draws_lamp = false;

  /// strategy[light][material]; not used where is_delta(light).
  std::vector<std::vector<LightStrategy>> strategy;

  /// precision[light][sphere] for highlights seen by the camera, with the reason in words. Rows are empty for lights
  /// with a size and beyond kMaxPairwiseSpheres: any direction is possible there.
  std::vector<std::vector<Precision>> precision;
  std::vector<Precision> any_direction_precision;  ///< by material, for all other directions
  std::string precision_reason;

  bool averages_highlights =
      false;              ///< that are smaller than a pixel (renderer/small_highlights.hpp)
  int first_samples = 1;  ///< of each pixel; the rest are taken only where these differ
  std::string sample_reason;
  Depth depth;         ///< of the reflections that are traced
  std::string kernel;  ///< the inner loops, in words

  /// Upper bounds; camera rays include the first samples around tiles.
  std::uint64_t camera_rays = 0, max_shadow_rays = 0, max_mirror_rays = 0, max_scattered_rays = 0;

  template <class Effect>
  bool on() const;  ///< plan/effects/catalogue.hpp
};

/// The interface of an effect: one file in renderer/plan/effects/ and one line in catalogue.hpp there.
template <class E>
concept EffectOfLight = requires(const Scene& scene, EffectPolicy policy, Plan& plan) {
  { E::kName } -> std::convertible_to<std::string_view>;
  { E::kWork } -> std::convertible_to<std::string_view>;
  /// Why a few samples of a pixel do not tell whether it needs more; empty if they do.
  { E::kHides } -> std::convertible_to<std::string_view>;
  /// Decides whether the scene calls for the effect, and why, and writes into the plan what to do for it. With
  /// EffectPolicy::kAll every scene calls for it.
  { E::decide(scene, policy, plan) } -> std::same_as<EffectDecision>;
};

/// Every highlight gets `precision` or, without one, the narrowest precision that its error bound allows. The policy
/// does not change the precision. Unless all effects are asked for, the plan is that of the scene without_idle_parts().
Plan make_plan(const Scene& scene, EffectPolicy policy,
               std::optional<Precision> precision = std::nullopt, Experiment experiment = {});

/// By material, a lower bound of |L + V| wherever the camera sees it lit, for shading_error_bound(). 0 where
/// nothing is known: on planes, in mirrors, through a lens, under lights with a size.
std::vector<double> min_half_lengths(const Scene& scene);

/// occluders[light][surface], spheres first, then planes: the surfaces that may stand between. Conservative: all
/// others can shadow no point of the surface. With EffectPolicy::kAll every other surface is in it. Where spheres or
/// lights are too many for occluders_by_surface() there is one entry for all surfaces: any other may hide the light.
bool occluders_by_surface(const Scene& scene);
std::vector<std::vector<Occluders>> find_occluders(const Scene& scene, const Contacts& contacts,
                                                   EffectPolicy policy);

/// Why every pixel needs all its samples, in words; empty if a few tell whether it needs the rest. Asks the plan
/// which effects are on that were decided before antialiasing.
std::string why_every_pixel(const Scene& scene, const Plan& plan);

/// The pixels from `begin` to before `end` along one axis.
struct PixelRange {
  int begin, end;
};
/// The pixels with first samples that tell whether the given pixels need the rest, in a picture of `size` pixels. The
/// range goes beyond the picture's edges if the filter does.
PixelRange looked_at(PixelRange pixels, int size, Filter filter);

}  // namespace lobelia
