// Milliseconds a megapixel over the errors of whole pictures.
#pragma once

#include "studies/cost/benchmarks.hpp"

namespace lobelia::cost {

/// A table for each scene: its ways are lobes by precisions, rendered by one thread.
std::vector<Table> measure_pictures(const Options& options);

}  // namespace lobelia::cost
