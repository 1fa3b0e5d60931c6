// The mean square error, which several metrics are made of.
#pragma once

#include <span>

#include "core/image.hpp"

namespace lobelia {

/// Over the R, G and B values of all pixels; in double, as a float32 sum loses a percent on a large
/// picture. 0 for pictures without pixels.
inline double mean_square_error(const Image& image, const Image& reference) {
  const std::span<const float> a = image.values(), b = reference.values();
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = double(a[i]) - double(b[i]);
    sum += difference * difference;
  }
  return a.empty() ? 0 : sum / double(a.size());
}

}  // namespace lobelia
