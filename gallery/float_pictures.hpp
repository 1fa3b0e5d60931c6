// The float pictures of a cell for its page's script: ours as it is, every other as its difference from ours,
// which shows how far they agree to many more digits than two rounded pictures could.
#pragma once

#include "gallery/checked_cell.hpp"
#include "gallery/packed_images.hpp"
#include "gallery/publisher.hpp"

namespace lobelia::gallery {

/// Bytes that the float pictures of a cell of 512 x 512 pixels may have in all; of a larger one in proportion.
inline constexpr std::size_t kFloatPictureBytes = 416 << 10;

/// Writes "ENGINE.float.js" for each EXR of the cell that can be read and is of the size of ours, and says so in
/// the images' `float_script`. Differences are kept with as many bits of mantissa as the bytes allow. A picture that cannot be read has none; its page shows the 8-bit one.
void publish_float_pictures(CellPictures& pictures, CheckedCell& cell, Publisher& publisher);

}  // namespace lobelia::gallery
