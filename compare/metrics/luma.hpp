// Luma: what structure metrics look at.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "compare/display_light.hpp"

namespace lobelia {

/// One channel, display-encoded, in [0, 1]; a type of its own, so that no linear light is taken for it.
/// In float32, which the pictures are.
struct LumaPlane {
  int width = 0, height = 0;
  std::vector<float> values;

  const float* row(int y) const { return values.data() + std::size_t(y) * std::size_t(width); }
};

/// Luma row by row, for whom a plane of a large picture would be too much.
struct LumaRows {
  int width = 0, height = 0;
  std::function<void(int y, float* row)> fill;  ///< may be called on many threads
};

/// Rec. 709 luma of the sRGB-encoded light (IEC 61966-2-1), not rounded to 8 bits. What is shown has to
/// outlive it.
LumaRows luma(const DisplayLight& shown);
/// Those of the plane, which has to outlive them.
LumaRows rows_of(const LumaPlane& plane);
LumaPlane plane_of(const LumaRows& rows);

/// Half the size, rounded up: means of 2 x 2 pixels; beyond an odd border its pixels repeat.
LumaPlane half_size(const LumaRows& whole);

}  // namespace lobelia
