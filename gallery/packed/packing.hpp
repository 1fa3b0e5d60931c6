// How pictures and texts become few bytes for a page's script, which reads them by lib/inflate.ts and lib/packed_pixels.ts.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace lobelia::gallery {

/// Bytes in base64, as a page's DecompressionStream("deflate") reads them; `level` 9 is the slowest, for the fewest.
std::string packed_bytes(std::string_view bytes, int level = 9);

/// Predicts a pixel from those left of it and above it, on a slope as at an edge: median edge detection (LOCO-I,
/// Weinberger, Seroussi, Sapiro 2000).
inline int predicted(int left, int above, int above_left) {
  if (above_left >= std::max(left, above)) return std::min(left, above);
  if (above_left <= std::min(left, above)) return std::max(left, above);
  return left + above - above_left;
}

}  // namespace lobelia::gallery
