// The largest error of a way of computing a lobe: found, not sampled.
#pragma once

#include <cstdint>

#include "studies/cost/lobe_variants.hpp"

namespace lobelia::cost {

struct LargestError {
  double found = 0;           ///< at a number that was looked at
  double at_most = 0;         ///< of any float32 number s; `found` where that is known
  std::uint64_t numbers = 0;  ///< that were looked at
};

/// The largest |way - cos^n| over the float32 numbers s. Beginning with `at_least`, which is known, wherever more is possible:
/// by how far the lobes are apart and by what the way's roundings are allowed, every number is looked at, or so many,
/// spread over all places. n is at least 2 or 1.
///
/// A way in float32 gives 1 where n s < 2^-26, and no more is lost there than 2^-26.
LargestError largest_error(const LobeVariant& way, double exponent, double at_least,
                           std::uint64_t most_numbers);

/// The second derivative over s of a lobe of the catalogue less cos^n is at most this, times n^2.
inline constexpr double kMostBend = 3.5;

}  // namespace lobelia::cost
