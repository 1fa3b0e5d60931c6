#include "compare/metrics/pixel_differences.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lobelia {

PixelDifferences pixel_differences(const DisplayLight& a, const DisplayLight& b,
                                   DifferenceKernel kernel) {
  const auto width = std::size_t(a.width()), height = std::size_t(a.height());
  PixelDifferences result{std::vector<float>(width * height), 0, 0};
  std::vector<double> row_sum(height, 0.0), row_max(row_sum);
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, height),
                            [&](const oneapi::tbb::blocked_range<std::size_t>& rows) {
                              std::vector<float> rgb_a(3 * width), rgb_b(rgb_a);
                              for (std::size_t y = rows.begin(); y < rows.end(); ++y) {
                                a.fill(int(y), 0, rgb_a);
                                b.fill(int(y), 0, rgb_b);
                                float* differences = result.values.data() + width * y;
                                kernel(rgb_a.data(), rgb_b.data(), differences, width);
                                double sum = 0;
                                float largest = 0;
                                for (std::size_t x = 0; x < width; ++x) {
                                  sum += double(differences[x]);
                                  largest = std::max(largest, differences[x]);
                                }
                                row_sum[y] = sum;
                                row_max[y] = double(largest);
                              }
                            });
  // In order of the rows: the sum must not depend on the number of threads.
  for (const double sum : row_sum) result.mean += sum;
  for (const double value : row_max) result.max = std::max(result.max, value);
  result.mean /= std::max(double(result.values.size()), 1.0);
  return result;
}

double percentile(std::vector<float>& values, double share) {
  const auto rank = std::size_t(std::ceil(share * double(values.size())));
  const auto at = values.begin() + std::ptrdiff_t(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), at, values.end());
  return double(*at);
}

}  // namespace lobelia
