// The cases of the agreement study: highlights of every kind, each effect that engines share, and effects that are averages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/scene.hpp"
#include "studies/agreement/example_scenes.hpp"

namespace lobelia::agreement {

/// The whole study, or a part that a test has time for.
struct Scope {
  bool small = false;
  int size = 0;  ///< width of pictures, pixels
};
inline constexpr int kFullSize = 96, kSmallSize = 64, kSmallestSize = 16, kLargestSize = 1024;

enum class Group { kHighlight, kEffect };
inline constexpr std::string_view kGroupNames[] = {"highlight", "effect"};

struct Case {
  Group group = Group::kHighlight;
  std::string_view what;  ///< the light of a highlight, or the effect
  HighlightChoice highlight;
  bool close_up = false;  ///< the camera sees the highlight alone
  int ring_allowed = 3;   ///< pixels of the ring that may be farther off than kRingOfPeak
  Scene scene;
};

/// A value on an edge is wrong if it is off by more than this share of the peak.
inline constexpr double kRingOfPeak = 1e-3;
/// Far squares of a checker have dozens of edges within the rounding of float32.
inline constexpr int kCheckerRing = 12;

/// From this exponent on a highlight is too small for a picture of the whole sphere. In a close-up the part above half of
/// its peak is at least a sixth of the picture wide.
inline constexpr double kCloseUpExponent = 1024;

std::vector<Case> highlight_cases(const Scope& scope);
std::vector<Case> effect_cases(const Scope& scope);

/// A scene that engines average, with highlights that are native to POV-Ray.
struct SoftCase {
  std::string what;
  Scene scene;
  /// The same for a renderer that samples, with negligible noise.
  Scene converged;
};
std::vector<SoftCase> soft_cases(const Scope& scope);
/// The numbers of points of the two estimates.
std::vector<int> soft_points(const Scope& scope);

}  // namespace lobelia::agreement
