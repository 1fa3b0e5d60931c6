// The level effects of `lobelia cost`.
#pragma once

#include <vector>

#include "studies/cost/benchmarks.hpp"

namespace lobelia::cost {

/// Of each scene given, or of everything() where none was: a way for the whole and one for each effect that it
/// calls for, without that effect.
std::vector<Table> measure_effects(const Options& options);

}  // namespace lobelia::cost
