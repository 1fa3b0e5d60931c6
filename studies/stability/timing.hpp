// What care costs. Medians of interleaved repeats, so that a change in the machine's speed meets all alike;
// printed and recorded, never asserted.
#pragma once

#include <vector>

#include "records/stability.hpp"
#include "renderer/highlight.hpp"

namespace lobelia::stability {

/// A kernel on inputs whose results would be denormal, beside ordinary ones. Of the lobes that get as small as that,
/// and last what it would cost: a product with a number that makes the results denormal ("no care").
std::vector<records::StabilityStall> measure_stalls(const std::vector<LobeId>& lobes);

/// Shading a point in each precision.
std::vector<records::StabilityPrice> measure_prices(const std::vector<LobeId>& lobes);

}  // namespace lobelia::stability
