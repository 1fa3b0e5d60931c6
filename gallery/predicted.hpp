#pragma once

#include <algorithm>

namespace lobelia::gallery {

/// Predicts a pixel from those left of it and above it, on a slope as at an edge: median edge detection (LOCO-I,
/// Weinberger, Seroussi, Sapiro 2000).
inline int predicted(int left, int above, int above_left) {
  if (above_left >= std::max(left, above)) return std::min(left, above);
  if (above_left <= std::min(left, above)) return std::max(left, above);
  return left + above - above_left;
}

}  // namespace lobelia::gallery
