// What care costs. Medians of interleaved repeats, so that a change in the machine's speed meets all alike;
// printed and recorded, never asserted.
#pragma once

#include <string>
#include <vector>

#include "renderer/highlight.hpp"

namespace lobelia::stability {

struct Timing {
  double median_ns = 0;  ///< for one value or point
  double spread_ns = 0;  ///< between the quartiles
};

/// A kernel on inputs whose results would be denormal, beside ordinary ones.
struct Stall {
  std::string lobe, precision;
  Timing ordinary, underflow;
};
/// Of the lobes that get as small as that, and last what it would cost: a product with a number that
/// makes the results denormal ("no care").
std::vector<Stall> measure_stalls(const std::vector<LobeId>& lobes);

/// Shading a point in each precision, by Precision.
struct Price {
  std::string lobe, model;
  Timing by_precision[3];
};
std::vector<Price> measure_prices(const std::vector<LobeId>& lobes);

}  // namespace lobelia::stability
