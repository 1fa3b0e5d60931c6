// A float picture as text that a script can carry: half floats, predicted from their neighbours so that what
// is left is mostly zeros, bytes in planes, deflated, base64. gallery/web/src/half_picture.ts reads it back.
#pragma once

#include "core/image.hpp"
#include "records/pages.hpp"

namespace lobelia::gallery {

/// From all that a half float has down to what even noise is short with.
inline constexpr int kFinest = 10, kCoarsest = -6;

/// Scene-linear values, rounded to the nearest half float with `precision` bits of mantissa; 0 and below: with one
/// bit, and 0 in place of what is under 2^-14, 2^-12, ... 2^-2 of the largest. What is not finite stays so.
/// A value is its half float * 2^-scale_log2.
records::PackedPicture half_picture(const Image& image, int precision);

}  // namespace lobelia::gallery
