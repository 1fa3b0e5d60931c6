// How far a render is from what endless samples would give.
#pragma once

#include "core/image.hpp"
#include "renderer/render.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Renders that an error is told from, and the degrees of freedom that it has.
inline constexpr int kErrorRenders = 16, kErrorFreedom = kErrorRenders - 1;

/// The standard error of each value of render(scene, options): how much it scatters over as many renders of the
/// same with the next seeds. Samples scrambled by another seed are independent, and each pixel has its own
/// scrambling, so that pixels err by themselves (renderer/sobol.hpp). 0 where nothing is random. The
/// picture is none of these renders. Throws as render().
Image standard_error_of_render(const Scene& scene, RenderOptions options);

}  // namespace lobelia
