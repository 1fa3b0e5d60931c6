// How far a highlight with one lobe is from the same with another, before any picture is made.
#pragma once

#include "renderer/highlight.hpp"

namespace lobelia::accuracy {

/// The most by which `stand_in` differs from `target` over all angles, of the target's peak: the largest
/// |c' f'(s) - c f(s)| / c over s = 0..1, f being the lobes and c their coefficients. Found on a grid as fine as
/// the lobes bend and refined there. Model and exponent are the same in both.
double highlight_difference(const Highlight& stand_in, const Highlight& target);

}  // namespace lobelia::accuracy
