// Where two pictures look different, for the script of a cell's page.
#pragma once

#include <vector>

#include "gallery/checked_cell.hpp"
#include "gallery/gallery.hpp"
#include "gallery/packed_images.hpp"
#include "gallery/publisher.hpp"

namespace lobelia::gallery {

/// Bytes that the maps of a cell of 512 x 512 pixels may have in all; of a larger one in proportion.
inline constexpr std::size_t kMapBytes = 96 << 10;
/// What is smaller is taken for 0: a thousandth of what is noticed.
inline constexpr float kLeastOfMap = 0x1p-10f;

/// Writes "ENGINE.map.ID.js" for each kind and each comparison of two pictures of one size on a plain display, and
/// says so in the comparisons' `maps`. One that is too large, as of noise, has of each block of pixels the largest
/// value alone.
void publish_difference_maps(CellPictures& pictures, const std::vector<MapKind>& kinds,
                             CheckedCell& cell, Publisher& publisher);

}  // namespace lobelia::gallery
