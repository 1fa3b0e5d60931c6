// What shading a point is expected to cost, from its operations alone: the same on every machine, so that
// what is chosen by it is too. `lobelia cost` is where times are measured.
#pragma once

#include "renderer/highlight.hpp"
#include "renderer/precision.hpp"

namespace lobelia::accuracy {

/// In multiplications of float32, for one point and one light: the lobe's operations, weighted, and the
/// rounding to a narrower precision. What does not depend on either is left out.
double shading_cost(LobeId lobe, Precision precision);

/// What a pixel of one light takes beside, in the same unit: ray, sphere, angle, memory.
inline constexpr double kPixelCost = 120;

}  // namespace lobelia::accuracy
