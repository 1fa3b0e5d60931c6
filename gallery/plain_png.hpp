// Reads the PNG files that write_png() writes, of which a gallery has a hundred thousand: 8-bit sRGB, not interlaced.
//
// A process for each (decision 17) would be most of the work. The file may be hostile: zlib writes at most the bytes that
// the size calls for, and every read is checked against the end.
#pragma once

#include <optional>
#include <string_view>

#include "core/image.hpp"

namespace lobelia::gallery {

/// Empty for any other file, and for a damaged one: read_image() knows more.
std::optional<DisplayImage> plain_png(std::string_view file);

}  // namespace lobelia::gallery
