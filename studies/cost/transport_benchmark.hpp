// The level transport of `lobelia cost`.
#pragma once

#include <vector>

#include "studies/cost/benchmarks.hpp"

namespace lobelia::cost {

/// Whether light of the scene has to be drawn at random: a light with a size, a sky, a lens or inter-reflection.
bool has_transport(const Scene& scene);

/// Built-in scenes, and those given that has_transport().
std::vector<Table> measure_transport(const Options& options);

}  // namespace lobelia::cost
