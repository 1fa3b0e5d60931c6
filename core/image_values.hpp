// Properties of a picture's values.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/image.hpp"
#include "core/scratch_memory.hpp"

namespace lobelia {

/// Whether no value is NaN or infinite.
inline bool is_finite(const Image& image) {
  bool finite = true;
  in_parts(image.values().size(), sizeof(float), [&](std::size_t begin, std::size_t end) {
    finite = finite && std::ranges::all_of(image.values().subspan(begin, end - begin),
                                           [](float value) { return std::isfinite(value); });
  });
  return finite;
}

/// The brightest R, G or B value; 0 without a positive value.
inline double peak_value(const Image& image) {
  float peak = 0;
  in_parts(image.values().size(), sizeof(float), [&](std::size_t begin, std::size_t end) {
    for (const float value : image.values().subspan(begin, end - begin))
      peak = std::max(peak, value);
  });
  return peak;
}

/// The largest finite |value|; 0 if there is none.
inline double largest_magnitude(std::span<const float> values) {
  float largest = 0;
  for (const float value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace lobelia
