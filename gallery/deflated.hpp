// Bytes as a page's DecompressionStream("deflate") reads them.
#pragma once

#include <string>
#include <string_view>

namespace lobelia::gallery {

std::string deflated(std::string_view bytes, int level = 6);
/// The slowest level, for the fewest bytes.
inline constexpr int kMostDeflated = 9;

}  // namespace lobelia::gallery
