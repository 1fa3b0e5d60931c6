// How far a picture is from another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/image.hpp"
#include "core/vec.hpp"

namespace lobelia::agreement {

/// Over all channels. Values that are not finite are infinitely far off.
struct Figures {
  // Pixels outside the ring:
  double max_of_peak = 0;  ///< of the peak of the reference
  double rms_of_peak = 0;  ///< over pixels where either picture is not black
  double max_relative =
      0;  ///< of the reference's value where that is above kRelativeFrom of the peak
  // Pixels in the ring:
  double ring_max_of_peak = 0;
  int ring_pixels = 0, ring_over = 0;  ///< all; those that are off by more than kRingOfPeak
};
inline constexpr double kRelativeFrom = 1e-3;

using Picture = std::vector<Rgb>;  ///< in reading order
Picture picture_of(const Image& image);

/// The sizes are the same; `ring` is that of truth::edge_ring().
Figures difference_from(const Picture& reference, const Image& image,
                        std::span<const std::uint8_t> ring);

/// The largest of each.
void widen(Figures& worst, const Figures& other);

}  // namespace lobelia::agreement
