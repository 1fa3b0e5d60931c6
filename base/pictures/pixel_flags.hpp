// A flag for each pixel of a picture: masks, regions and edges.
#pragma once

#include "base/pictures/image.hpp"

namespace lobelia {

/// By pixel in reading order, 0: no. Large ones are kept in files where pictures are (base/system/scratch_memory.hpp).
using PixelFlags = std::vector<std::uint8_t, ZeroedMemory<std::uint8_t>>;

}  // namespace lobelia
