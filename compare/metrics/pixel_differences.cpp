#include "compare/metrics/pixel_differences.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lobelia {

PixelDifferences pixel_differences(const DisplayLight& a, const DisplayLight& b,
                                   DifferenceKernel kernel, std::span<const std::uint8_t> region) {
  const auto width = std::size_t(a.width()), height = std::size_t(a.height());
  PixelDifferences result{std::vector<float>(width * height), 0, 0};
  std::vector<double> row_sum(height, 0.0), row_max(row_sum);
  const auto is_left_out = [&](std::size_t pixel) { return !region.empty() && region[pixel] == 0; };
  oneapi::tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
    if (!region.empty() && std::ranges::count(region.subspan(width * y, width), 0) == int(width))
      return;
    std::vector<float> rgb_a(3 * width), rgb_b(rgb_a);
    a.fill(int(y), 0, rgb_a);
    b.fill(int(y), 0, rgb_b);
    const std::span<float> differences(result.values.data() + width * y, width);
    kernel(rgb_a.data(), rgb_b.data(), differences.data(), width);
    for (std::size_t x = 0; x < width; ++x) {
      if (is_left_out(width * y + x)) continue;
      row_sum[y] += double(differences[x]);
      row_max[y] = std::max(row_max[y], double(differences[x]));
    }
  });
  // In order of the rows: the sum must not depend on the number of threads.
  for (const double sum : row_sum) result.mean += sum;
  for (const double value : row_max) result.max = std::max(result.max, value);
  std::size_t kept = 0;
  for (std::size_t pixel = 0; pixel < result.values.size(); ++pixel)
    if (!is_left_out(pixel)) result.values[kept++] = result.values[pixel];
  result.values.resize(kept);
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
