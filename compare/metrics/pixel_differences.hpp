// A difference of each pixel as shown, for the metrics that are made of those.
#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <vector>

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// difference(Rgb a, Rgb b) of every pixel in reading order; 0 where both sides show the same light.
template <class Difference>
std::vector<double> pixel_differences(const MetricInput& input, Difference difference) {
  std::vector<double> differences(input.shown_a.pixel_count());
  constexpr std::size_t kPixelsPerTask = 4096;
  oneapi::tbb::parallel_for(
      oneapi::tbb::blocked_range<std::size_t>(0, differences.size(), kPixelsPerTask),
      [&](const oneapi::tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const Rgb a = input.shown_a.at(i), b = input.shown_b.at(i);
          differences[i] = a == b ? 0 : difference(a, b);
        }
      });
  return differences;
}

}  // namespace lobelia
