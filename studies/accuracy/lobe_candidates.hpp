// A scene with another lobe: which lobes are tried to save time, how far each is off, and its cost.
#pragma once

#include <optional>
#include <vector>

#include "renderer/precision.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::accuracy {

/// Every highlight with that lobe, and the coefficient that makes its energy exact. A material that has the
/// lobe already stays as it is, coefficient included.
Scene with_lobe(const Scene& scene, LobeId lobe);
Highlight with_lobe(Highlight highlight, LobeId lobe);

/// The lobe of all highlights, or none where they differ or there is no highlight.
std::optional<LobeId> own_lobe(const Scene& scene);

/// The catalogue's lobes; also the scene's own, and cs_n, which is cos^n without a logarithm, for each exponent n that is
/// an even number.
std::vector<LobeId> lobe_candidates(const Scene& scene);

/// The largest difference of `stand_in` from `target` over all angles, relative to the target's peak: of
/// |c' f'(s) - c f(s)| / c over s = 0..1, f being the lobes and c their coefficients. Found on a grid as fine as
/// the lobes bend and refined there. Model and exponent are the same in both.
double highlight_difference(const Highlight& stand_in, const Highlight& target);

/// The expected cost of a point and a light: the lobe's price (renderer/operation_count.hpp) and that of rounding to a
/// narrower precision, without the rest, which is the same for all.
double shading_cost(LobeId lobe, Precision precision);

}  // namespace lobelia::accuracy
