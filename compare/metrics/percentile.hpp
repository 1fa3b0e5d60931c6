// Mean, percentiles and maximum of a difference per pixel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lobelia {

/// The smallest value that at least `share` of the values do not exceed: the nearest rank, without
/// interpolation, so that it is a value which some pixel has. 0 < share <= 1; reorders the values.
inline double percentile(std::vector<double>& values, double share) {
  const auto rank = std::size_t(std::ceil(share * double(values.size())));
  const auto at = values.begin() + std::ptrdiff_t(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Summed in their order: the mean must not depend on the number of threads.
inline double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

inline double maximum(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

}  // namespace lobelia
