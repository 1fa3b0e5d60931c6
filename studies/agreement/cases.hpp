// The cases of the agreement study: highlights of every kind, each effect that engines share, and effects that are averages.
#pragma once

#include <string_view>
#include <vector>

#include "renderer/scene/scene.hpp"
#include "studies/agreement/example_scenes.hpp"

namespace lobelia::agreement {

/// How much of it: all, or what a test has time for.
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
  /// Pixels of the ring that may be farther off than kRingOfPeak.
  int ring_allowed = 3;
  Scene scene;
};

/// A value on an edge is wrong if it is this much of the peak off.
inline constexpr double kRingOfPeak = 1e-3;
/// Edges of far squares of a checker are met within the rounding of float32 by the dozen.
inline constexpr int kCheckerRing = 12;

/// From this exponent on a highlight is too small for a picture of the whole sphere. In the close-up what is
/// above half of its peak is a sixth of the picture wide or more.
inline constexpr double kCloseUpExponent = 1024;

std::vector<Case> highlight_cases(const Scope& scope);
std::vector<Case> effect_cases(const Scope& scope);

/// A scene of which engines make averages, with highlights that POV-Ray has itself.
struct SoftCase {
  std::string_view what;
  Scene scene;
  /// The same for a renderer that samples: as many that its noise counts for nothing.
  Scene converged;
};
std::vector<SoftCase> soft_cases(const Scope& scope);
/// The numbers of points of both estimates.
std::vector<int> soft_points(const Scope& scope);

}  // namespace lobelia::agreement
