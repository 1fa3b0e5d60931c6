// An effect of light, as the plan decides on it. Each is one file in renderer/plan/effects/ and one line in
// the table renderer/plan/effects/catalogue.hpp.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lobelia {

struct Experiment;
struct Plan;
struct Scene;

enum class EffectPolicy { kAsCalledFor, kAll };

struct EffectDecision {
  std::string_view name;  ///< "shadows"
  std::string_view work;  ///< what it costs, as counted in every record: "shadow rays"
  bool on = false;
  std::string reason;           ///< in words: "no sphere can stand between another one and a light"
  std::string_view hides = {};  ///< E::kHides; set by the planner
};

/// The interface of an effect. decide() says whether the scene calls for it and why, and writes into the plan what to do for
/// it. With EffectPolicy::kAll every scene calls for it.
template <class E>
concept EffectOfLight = requires(const Scene& scene, EffectPolicy policy, Plan& plan,
                                 Scene& changed, Experiment& experiment) {
  { E::kName } -> std::convertible_to<std::string_view>;
  { E::kWork } -> std::convertible_to<std::string_view>;
  /// Why a few samples of a pixel do not tell whether it needs more; empty where they do.
  { E::kHides } -> std::convertible_to<std::string_view>;
  { E::decide(scene, policy, plan) } -> std::same_as<EffectDecision>;
  /// What stands in its place where it is left out: "a pinhole".
  { E::kWithout } -> std::convertible_to<std::string_view>;
  /// Changes the scene so that nothing calls for it; the experiment, where no scene can say that.
  E::leave_out(changed, experiment);
};

}  // namespace lobelia
