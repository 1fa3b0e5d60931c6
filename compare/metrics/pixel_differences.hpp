// One difference per pixel as shown, and the figures that metrics make of them.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// Writes the differences of `count` pixels, given R, G and B of each as shown. Equal pixels give 0.
using DifferenceKernel = void (*)(const float* rgb_a, const float* rgb_b, float* differences,
                                  std::size_t count);

/// The differences of all pixels. With `needed`, only those in rows where it is not all zero are computed; the others are 0.
PixelValues pixel_differences(const DisplayLight& a, const DisplayLight& b, DifferenceKernel kernel,
                              std::span<const std::uint8_t> needed = {});

/// Writes the mean of the input's region, the percentiles of the given shares, and the maximum, in this order. All are 0
/// without pixels. The mean is summed in double, each row by itself and the rows from the top, so that it does not
/// depend on the number of threads.
void write_figures(const PixelValues& values, const MetricInput& input,
                   std::initializer_list<double> shares, std::span<double> figures);

/// The smallest value that at least `share` of the values do not exceed: the nearest rank, without
/// interpolation, so some pixel has this value. 0 < share <= 1; there must be at least one value, and no NaN.
double percentile(std::span<const float> values, double share);

/// The values before which so many others stand in ascending order, of the pixels where `region` is not 0; empty: of all.
/// Each rank must be less than their number. No NaN.
std::vector<float> nth_values(std::span<const float> values, std::span<const std::size_t> ranks,
                              std::span<const std::uint8_t> region = {});
float nth_value(std::span<const float> values, std::size_t rank);

}  // namespace lobelia
