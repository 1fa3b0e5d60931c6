// Whether an average of independent estimates is the picture that it estimates.
#pragma once

#include <cstddef>

#include "core/image.hpp"
#include "reference_scenes/engine.hpp"

namespace lobelia {

/// Counts are of values, three a pixel.
struct ReplicateStatistics {
  std::size_t values = 0;
  std::size_t random = 0;     ///< whose difference is more than rounding
  std::size_t of_twenty = 0;  ///< of these farther off than one in twenty is by chance
  /// Farther off than any of the picture's values is by chance in one picture of a thousand: Student's t
  /// with Sidak's correction for that many values.
  std::size_t beyond = 0;
  double rms = 0;  ///< of the difference, in radiance
};

/// `result` is an average of kReplicates estimates with `points` points in all; `rounding` is what a value may
/// be off by the engine's number format, as a part of it.
ReplicateStatistics replicate_statistics(const ReferenceResult& result, const Image& truth,
                                         int points, double rounding);

}  // namespace lobelia
