// How a blob is measured, again and again: with other noise, and at other places of a pixel.
#pragma once

#include <array>
#include <vector>

#include "profile/falloff_fit.hpp"
#include "profile/outline.hpp"

namespace lobelia {

inline constexpr double kEnergyReach = 3;  ///< of the disc, in long semi-axes
/// 2 sigma of the pixels above half of a Gaussian, weighted by their height, over its half-width.
inline constexpr double kSemiAxis = 0.941;

/// The facts known in advance, in the coordinates of a field of the blob over its background.
struct BlobMeasurement {
  std::vector<std::size_t> region, ring;
  Axes rough;
  double noise = 0;  ///< of the peak

  struct Result {
    double shift = 0;  ///< of the background
    Outline outline;
    Axes axes;
    std::size_t pixels = 0;
    double energy = 0;

    static constexpr std::size_t kFigures = 9;
    /// Shift, value and place of the peak, centroid, half-widths, energy.
    std::array<double, kFigures> figures() const;
  };
  Result measure(Field above) const;

  /// How far measure() itself and its background are off, by each figure: the root mean square over a curve of known figures
  /// at several places of a pixel. `curve` is what fits the blob; `field` has its size. NaN where nothing is measured.
  std::array<double, Result::kFigures> method_errors(const FalloffFit& curve, const Field& field,
                                                     double semi_axis) const;
};

}  // namespace lobelia
