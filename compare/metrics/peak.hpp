// The scale that errors of a highlight are read by.
#pragma once

#include <algorithm>

#include "core/image.hpp"

namespace lobelia {

/// The brightest R, G or B value of the picture; 0 for a picture without a positive value.
inline double peak_value(const Image& image) {
  float peak = 0;
  for (const float value : image.values()) peak = std::max(peak, value);
  return peak;
}

}  // namespace lobelia
