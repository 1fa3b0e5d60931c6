// A float picture as text that a script can carry: half floats, minus a prediction from their neighbours so that most
// bytes are zero, in planes of bytes, deflated, base64. gallery/web/src/half_picture.ts reads it back.
#pragma once

#include "base/pictures/image.hpp"
#include "base/records/pages.hpp"

namespace lobelia::gallery {

/// Precisions: from all bits of a half float down to few enough that even noise packs well.
inline constexpr int kFinest = 10, kCoarsest = -6;

/// Scene-linear values, rounded to the nearest half float with `precision` bits of mantissa. Precisions 0, -1, ... -6 mean
/// one bit, and 0 in place of values under 2^-14, 2^-12, ... 2^-2 of the largest. NaNs and infinities are kept.
/// A value is its half float * 2^-scale_log2.
records::PackedPicture half_picture(const Image& image, int precision);

}  // namespace lobelia::gallery
