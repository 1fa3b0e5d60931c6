// Luma: what structure metrics look at.
#pragma once

#include <cstddef>
#include <vector>

#include "compare/display_light.hpp"

namespace lobelia {

/// One channel, display-encoded, in [0, 1]; a type of its own, so that no linear light is taken for it.
/// In float32, which the pictures are: two of them are a third of a picture.
struct LumaPlane {
  int width = 0, height = 0;
  std::vector<float> values;

  const float* row(int y) const { return values.data() + std::size_t(y) * std::size_t(width); }
};

/// Rec. 709 luma of the sRGB-encoded light (IEC 61966-2-1), not rounded to 8 bits.
LumaPlane luma(const DisplayLight& shown);

/// Half the size, rounded up: means of 2 x 2 pixels; beyond an odd border its pixels repeat.
LumaPlane half_size(const LumaPlane& plane);

}  // namespace lobelia
