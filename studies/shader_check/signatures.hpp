// Causes that are seen by their own signs, not by what a changed formula leaves.
#pragma once

#include <string>

#include "studies/shader_check/search.hpp"

namespace lobelia::shader_check {

/// Whether the differences from a formula are those of a cosine that is off by float32's rounding: as small, and of both
/// signs. The difference grows with the exponent.
bool is_rounding_of_cosine(const Candidate& candidate, const Observed& observed);

/// Whether the calls that gave NaN are those with a cosine of the lobe below 0.
bool is_power_of_negative(const Candidate& candidate, const Observed& observed);

}  // namespace lobelia::shader_check
