#include "compare/metrics/pixel_differences.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lobelia {

PixelDifferences pixel_differences(const DisplayLight& a, const DisplayLight& b,
                                   DifferenceKernel kernel) {
  const auto width = std::size_t(a.width()), height = std::size_t(a.height());
  PixelDifferences result{std::vector<float>(width * height), 0, 0};
  std::vector<double> row_sum(height, 0.0), row_max(row_sum);
  oneapi::tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
    std::vector<float> rgb_a(3 * width), rgb_b(rgb_a);
    a.fill(int(y), 0, rgb_a);
    b.fill(int(y), 0, rgb_b);
    const std::span<float> differences(result.values.data() + width * y, width);
    kernel(rgb_a.data(), rgb_b.data(), differences.data(), width);
    for (const float difference : differences) {
      row_sum[y] += double(difference);
      row_max[y] = std::max(row_max[y], double(difference));
    }
  });
  // In order of the rows: the sum must not depend on the number of threads.
  for (const double sum : row_sum) result.mean += sum;
  for (const double value : row_max) result.max = std::max(result.max, value);
  result.mean /= std::max(double(result.values.size()), 1.0);
  return result;
}

void PixelDifferences::write_figures(std::initializer_list<double> shares,
                                     std::span<double> figures) {
  figures.front() = mean;
  figures.back() = max;
  std::ranges::transform(shares, figures.begin() + 1, [&](double share) {
    return values.empty() ? 0 : percentile(values, share);
  });
}

double percentile(std::vector<float>& values, double share) {
  const auto rank = std::size_t(std::ceil(share * double(values.size())));
  const auto at = values.begin() + std::ptrdiff_t(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), at, values.end());
  return double(*at);
}

}  // namespace lobelia
