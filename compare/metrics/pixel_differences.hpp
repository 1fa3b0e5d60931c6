// A difference of each pixel as shown, for the metrics that are made of those.
#pragma once

#include <cstddef>
#include <vector>

#include "compare/display_light.hpp"

namespace lobelia {

/// Fills in the differences of `count` pixels, R, G and B of each as shown; 0 for pixels that show the same.
using DifferenceKernel = void (*)(const float* rgb_a, const float* rgb_b, float* differences,
                                  std::size_t count);

struct PixelDifferences {
  /// In reading order, in float32: 256 MB of a picture of 8192 x 8192, and no order is lost by rounding.
  std::vector<float> values;
  double mean, max;  ///< 0 of a picture without pixels
};

/// The same for any number of threads.
PixelDifferences pixel_differences(const DisplayLight& a, const DisplayLight& b,
                                   DifferenceKernel kernel);

/// The smallest value that at least `share` of the values do not exceed: the nearest rank, without
/// interpolation, so that it is a value which some pixel has. 0 < share <= 1; reorders the values, of which
/// there has to be one.
double percentile(std::vector<float>& values, double share);

}  // namespace lobelia
