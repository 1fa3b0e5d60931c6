// A float picture as text that a script can carry: half floats, predicted from their neighbours so that what
// is left is mostly zeros, bytes in planes, deflated, base64. gallery/web/src/half_picture.ts reads it back.
#pragma once

#include <string>

#include "core/image.hpp"

namespace lobelia::gallery {

/// Value = half * 2^-scale, exact to the bits of the mantissa that were kept.
struct HalfPicture {
  int width = 0, height = 0;
  int scale_log2 = 0;
  int mantissa_bits = 10;  ///< of a half float's 10
  double least = 0;        ///< what is smaller was taken for 0
  bool is_predicted = true;
  std::string base64;
};

/// From all that a half float has down to what even noise is short with.
inline constexpr int kFinest = 10, kCoarsest = -6;

/// Scene-linear values, rounded to the nearest half float with `precision` bits of mantissa; 0 and below: with one
/// bit, and 0 in place of what is under 2^-14, 2^-12, ... 2^-2 of the largest. What is not finite stays so.
HalfPicture half_picture(const Image& image, int precision);

}  // namespace lobelia::gallery
