// What a profile calls radiance.
#pragma once

#include <cstddef>

#include "core/image.hpp"

namespace lobelia {

/// Of a pixel in reading order: the mean of R, G and B.
inline double radiance_at(const Image& image, std::size_t index) {
  const float* value = image.values().data() + 3 * index;
  return (double(value[0]) + double(value[1]) + double(value[2])) / 3;
}

}  // namespace lobelia
