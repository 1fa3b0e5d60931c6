// Errors of RGB values, over the pixels of the input's region.
#pragma once

#include <algorithm>
#include <cmath>

#include "compare/metrics/metric.hpp"
#include "core/scratch_memory.hpp"

namespace lobelia {

/// Calls visit(a, b, pixel) for each RGB value of the region in reading order. Returns the number of calls.
template <class Visit>
std::size_t for_each_value(const MetricInput& input, Visit visit) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  std::size_t count = 0;
  in_parts(a.size() / 3, 6 * sizeof(float), [&](std::size_t begin, std::size_t end) {
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      if (!input.in_region(pixel)) continue;
      for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
        visit(double(a[i]), double(b[i]), pixel);
      count += 3;
    }
  });
  return count;
}

/// Mean of error(a, b); 0 for a region without pixels. Summed in double: a float32 sum loses a percent on a
/// large picture.
template <class Error>
double mean_over(const MetricInput& input, Error error) {
  double sum = 0;
  const std::size_t count =
      for_each_value(input, [&](double a, double b, std::size_t) { sum += error(a, b); });
  return count == 0 ? 0 : sum / double(count);
}

inline double mean_square_error(const MetricInput& input) {
  return mean_over(input, [](double a, double b) { return (a - b) * (a - b); });
}

}  // namespace lobelia
