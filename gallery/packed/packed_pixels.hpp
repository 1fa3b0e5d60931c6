// 8-bit pictures as bytes that deflate well: minus a prediction; first green of all pictures, then red minus green of all,
// then blue minus green. gallery/web/src/lib/packed_pixels.ts reads them back.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/pictures/image.hpp"

namespace lobelia::gallery {

/// Bits of a picture's `way`.
inline constexpr int kFromNeighbours = 1, kFromFirst = 2;

struct PackedPixels {
  std::vector<int> ways;  ///< a picture each
  std::string bytes;      ///< 3 * width * height of each picture
};

/// Each picture as it is shortest: minus the first if that has its size, minus what its neighbours predict, both, or
/// neither. A picture may have no pixels.
PackedPixels packed_pixels(std::span<const DisplayImage> pictures);

}  // namespace lobelia::gallery
