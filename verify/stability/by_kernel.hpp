// A value as the renderer's kernels compute it.
#pragma once

#include "renderer/highlight.hpp"
#include "verify/stability/long_double.hpp"

namespace lobelia::stability {

/// Lobe times foreshortening in the precision that the plan would choose, whose bound `bound` becomes.
double by_kernel(const Highlight& h, const ScreenedVectors& v, double& bound);

}  // namespace lobelia::stability
