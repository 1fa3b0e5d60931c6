// One difference per pixel as shown, and the figures that metrics make of them.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "compare/display_light.hpp"

namespace lobelia {

/// Writes the differences of `count` pixels, given R, G and B of each as shown. Equal pixels give 0.
using DifferenceKernel = void (*)(const float* rgb_a, const float* rgb_b, float* differences,
                                  std::size_t count);

struct PixelDifferences {
  /// In reading order. float32 halves the memory (256 MB for 8192 x 8192 pixels); rounding keeps the order.
  std::vector<float, ZeroedMemory<float>> values;
  double mean, max;  ///< 0 for a picture without pixels

  /// Writes mean, percentiles of the given shares, and maximum, in this order. All are 0 without pixels.
  void write_figures(std::initializer_list<double> shares, std::span<double> figures) const;
};

/// Of the pixels where `region` is not 0; empty: of all. The result does not depend on the number of threads.
PixelDifferences pixel_differences(const DisplayLight& a, const DisplayLight& b,
                                   DifferenceKernel kernel,
                                   std::span<const std::uint8_t> region = {});

/// The smallest value that at least `share` of the values do not exceed: the nearest rank, without
/// interpolation, so some pixel has this value. 0 < share <= 1; there must be at least one value, and no NaN.
double percentile(std::span<const float> values, double share);

/// The value before which `rank` others stand in ascending order; rank < values.size(), no NaN.
float nth_value(std::span<const float> values, std::size_t rank);

}  // namespace lobelia
