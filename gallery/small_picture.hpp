// Pictures for a first look, where the picture itself would be too heavy for that.
#pragma once

#include <filesystem>

#include "gallery/checked_cell.hpp"
#include "gallery/publisher.hpp"

namespace lobelia::gallery {

inline constexpr int kSmallSide = 160;  ///< pixels, of the longer side
inline constexpr std::uintmax_t kLightBytes =
    48 << 10;  ///< a picture up to this size is shown as it is

/// Writes "NAME.small.png" of every picture of the cell that is heavier than that, and says so in its `small`; with
/// `all` also of every one that is longer than kSmallSide.
void publish_small_pictures(const std::filesystem::path& run, CheckedCell& cell, bool all,
                            Publisher& publisher);

}  // namespace lobelia::gallery
