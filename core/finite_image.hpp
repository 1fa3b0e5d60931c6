// Whether a picture has numbers alone.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/image.hpp"

namespace lobelia {

/// No value of it is a NaN or an infinity.
inline bool is_finite(const Image& image) {
  return std::all_of(image.values().begin(), image.values().end(),
                     [](float value) { return std::isfinite(value); });
}

}  // namespace lobelia
