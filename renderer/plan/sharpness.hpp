// Whether a few samples of a pixel and its neighbours show all that is in it.
#pragma once

#include <string>

#include "renderer/plan/plan.hpp"

namespace lobelia {

/// Why every pixel needs all its samples, in words; empty where a few tell whether it needs the rest.
/// Asks the plan which effects are on that come before antialiasing.
std::string why_every_pixel(const Scene& scene, const Plan& plan);

/// Along one axis: the pixels from `begin` to before `end`.
struct PixelRange {
  int begin, end;
};
/// Those whose first samples tell whether the given ones need the rest, in a picture of `size` pixels. What lies
/// beyond its edges counts where the filter reaches it.
PixelRange looked_at(PixelRange pixels, int size, Filter filter);

}  // namespace lobelia
