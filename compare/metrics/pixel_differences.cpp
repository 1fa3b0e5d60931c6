#include "compare/metrics/pixel_differences.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/scratch_memory.hpp"

namespace lobelia {
namespace {

constexpr std::uint32_t kSign = 1u << 31;

/// Numbers in the order of the floats.
std::uint32_t in_order(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}
float from_order(std::uint32_t number) {
  return std::bit_cast<float>((number & kSign) != 0 ? number & ~kSign : ~number);
}

}  // namespace

PixelDifferences pixel_differences(const DisplayLight& a, const DisplayLight& b,
                                   DifferenceKernel kernel, std::span<const std::uint8_t> region) {
  const auto width = std::size_t(a.width()), height = std::size_t(a.height());
  PixelDifferences result{};
  result.values.resize(width * height);
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
    looked_at(differences.size_bytes());
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
  if (!region.empty())
    in_parts(result.values.size(), 2 * sizeof(float), [&](std::size_t begin, std::size_t end) {
      for (std::size_t pixel = begin; pixel < end; ++pixel)
        if (!is_left_out(pixel)) result.values[kept++] = result.values[pixel];
    });
  if (!region.empty()) result.values.resize(kept);
  result.mean /= std::max(double(result.values.size()), 1.0);
  return result;
}

void PixelDifferences::write_figures(std::initializer_list<double> shares,
                                     std::span<double> figures) const {
  figures.front() = mean;
  figures.back() = max;
  std::ranges::transform(shares, figures.begin() + 1, [&](double share) {
    return values.empty() ? 0 : percentile(values, share);
  });
}

double percentile(std::span<const float> values, double share) {
  const auto rank = std::size_t(std::ceil(share * double(values.size())));
  return double(nth_value(values, std::max<std::size_t>(rank, 1) - 1));
}

float nth_value(std::span<const float> values, std::size_t rank) {
  // Digit by digit, from the highest: no copy, and one pass over the values for each.
  constexpr int kDigitBits = 16;
  std::uint32_t found = 0, known = 0;  // digits so far
  for (int shift = 32 - kDigitBits; shift >= 0; shift -= kDigitBits) {
    constexpr std::uint32_t kDigit = (1u << kDigitBits) - 1;
    std::vector<std::size_t> counts(kDigit + 1);
    in_parts(values.size(), sizeof(float), [&](std::size_t begin, std::size_t end) {
      for (const float value : values.subspan(begin, end - begin))
        if (const std::uint32_t number = in_order(value); (number & known) == found)
          ++counts[number >> shift & kDigit];
    });
    std::uint32_t digit = 0;
    for (; rank >= counts[digit]; ++digit) rank -= counts[digit];
    found |= digit << shift;
    known |= kDigit << shift;
  }
  return from_order(found);
}

}  // namespace lobelia
