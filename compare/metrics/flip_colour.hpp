// The colour spaces of LDR-FLIP, with the constants of the reference tool (see flip_ldr.cpp).
#pragma once

#include "core/vec.hpp"

namespace lobelia {

/// YCxCz: Lab without its cube root, in which light may be blurred. y is 100 for white.
struct FlipColour {
  float y, cx, cz;
};

FlipColour flip_colour(Rgb shown);

/// HyAB distance of two filtered colours as a display could show them, in Lab with the Hunt effect,
/// raised to FLIP's exponent.
float flip_distance(FlipColour a, FlipColour b);

/// The largest such distance between colours of a display: its green and its blue.
float flip_largest_distance();

}  // namespace lobelia
