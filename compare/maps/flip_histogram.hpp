// The weighted histogram of FLIP errors.
//
// Source:       P. Andersson, J. Nilsson, T. Akenine-Moeller, "Visualizing and Communicating Errors in Rendered Images",
//               Ray Tracing Gems II, 2021; NVIDIA's FLIP tool 1.6 (--histogram).
// Formula:      100 buckets from 0 to 1, of which the last holds 1. The height of a bucket is its number of pixels times
//               the error in its middle, for each 1024 x 1024 pixels of the picture. So many pixels with a small error
//               and few with a large one can both be seen. A weighted quantile is the first error, in rising order, at
//               which the sum of the errors is over its share of the sum of all; 0 if all errors are 0.
// Agrees with:  the tool, in all buckets and figures of the pictures of the test.
// Differs:      sums are in double; the tool's are float32.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace lobelia {

inline constexpr int kFlipBuckets = 100;

struct FlipHistogram {
  std::array<std::int64_t, kFlipBuckets> pixels{};
  std::array<double, kFlipBuckets> weighted{};  ///< the heights
  double mean = 0, least = 0, largest = 0;
  double first_quartile = 0, median = 0, third_quartile = 0;  ///< weighted
};

/// The errors are from 0 to 1. Without errors every figure is 0.
FlipHistogram flip_histogram(std::span<const float> errors);

/// RFC 4180: a line for each bucket, "from,to,pixels,weighted_per_megapixel".
std::string histogram_csv(const FlipHistogram& histogram);

/// A file with the heights, and lines at the mean, the weighted median and the weighted quartiles. `title` names the
/// error: "LDR-FLIP".
std::string histogram_svg(const FlipHistogram& histogram, const std::string& title);

}  // namespace lobelia
