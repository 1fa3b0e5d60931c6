// The level engine of `lobelia cost`.
#pragma once

#include <vector>

#include "studies/cost/benchmarks.hpp"

namespace lobelia::cost {

/// Of each scene given, with one ray a pixel: our program and every engine that is here and can show it.
std::vector<Table> measure_engines(const Options& options);

}  // namespace lobelia::cost
