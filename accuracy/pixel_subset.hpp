// A look at a picture before it is made.
#pragma once

#include "renderer/scene/scene.hpp"

namespace lobelia::accuracy {

/// The same scene with a film of every k-th pixel of every k-th row, k odd, some `side` on the longer side: of
/// one ray a pixel, its pixels are the picture's own. Fewer than k rows and columns are left out at the end.
Scene pixel_subset(const Scene& scene, int side);

}  // namespace lobelia::accuracy
