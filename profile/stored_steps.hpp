// The steps between the numbers that a picture's file can hold, found from the picture's own values.
//
// A value in a file of half floats or of 8 bits is off by up to half a step. Where neighbouring pixels have the same value,
// their scatter does not show it.
#pragma once

#include <cstddef>

#include "base/pictures/image.hpp"

namespace lobelia {

class StoredSteps {
 public:
  /// All finite values are numbers of 8, 10, 12 or 16 bits in [0, 1], linear or as sRGB has them, or half floats; otherwise
  /// the steps are those of float32. O(pixels).
  explicit StoredSteps(const Image& image);

  /// The step at a linear value.
  double at(double value) const;
  /// The standard deviation of the rounding of a pixel's radiance, the mean of R, G and B, whose roundings may be equal.
  double rounding(const Image& image, std::size_t pixel) const;

 private:
  enum class Kind { kFloat, kHalf, kLinear, kSrgb };
  static bool holds(Kind kind, double levels, float value);

  Kind kind_ = Kind::kFloat;
  double levels_ = 0;  ///< of an integer, the largest
};

}  // namespace lobelia
