// Errors of RGB values, over the pixels of the input's region.
#pragma once

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// The metrics that are made of ValueErrors.
inline constexpr std::string_view kValueErrors = "value errors";

/// Bounds the weight of black pixels in relmse.
inline constexpr double kRelmseEpsilon = 0.01;

/// Summed in double, as a float32 sum loses a percent on a large picture; each row by itself, and the rows from the top.
/// So the sums do not depend on the number of threads. They are off by at most as many roundings (1.1e-16) of the sum of
/// sizes as there are values in a row and rows: of 1920 x 1080, 8e-13.
struct ValueErrors {
  std::size_t count = 0;                                         ///< R, G and B values
  double sizes = 0, squares = 0, differences = 0, relative = 0;  ///< sums
  double largest = 0;
  std::size_t where = 0;  ///< the first pixel in reading order that has the largest

  double mean(double sum) const { return count == 0 ? 0 : sum / double(count); }
};

std::shared_ptr<const ValueErrors> value_errors(const MetricInput& input);

/// The brightest RGB value of the reference, 0 if none is positive.
double reference_peak(const MetricInput& input);

}  // namespace lobelia
