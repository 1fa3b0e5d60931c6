#include "compare/metrics/pixel_differences.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/pictures/image.hpp"
#include "base/system/scratch_memory.hpp"

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

/// The rank that is the percentile of a share.
std::size_t rank_of(double share, std::size_t count) {
  return std::max<std::size_t>(std::size_t(std::ceil(share * double(count))), 1) - 1;
}

/// Up to a quarter of a MiB for each thread, pass and beginning, whose pages come at once.
using Counts = std::vector<std::uint32_t, ZeroedMemory<std::uint32_t>>;

/// On many threads, visit(counts, number) for each value of the region. Returns the sums of all threads' `size` counts.
template <class Visit>
Counts count_numbers(std::span<const float> values, std::span<const std::uint8_t> region,
                     std::size_t size, const Visit& visit) {
  constexpr std::size_t kPart = std::size_t{1} << 16;
  oneapi::tbb::enumerable_thread_specific<Counts> of_threads(size);
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, values.size(), kPart),
                            [&](const auto& part) {
                              Counts& counts = of_threads.local();
                              for (std::size_t i = part.begin(); i < part.end(); ++i)
                                if (region.empty() || region[i] != 0)
                                  visit(counts, in_order(values[i]));
                              looked_at(part.size() * sizeof(float));
                            });
  Counts all(size);
  for (const Counts& one : of_threads) std::ranges::transform(all, one, all.begin(), std::plus());
  return all;
}

}  // namespace

PixelValues pixel_differences(const DisplayLight& a, const DisplayLight& b, DifferenceKernel kernel,
                              std::span<const std::uint8_t> needed) {
  const auto width = std::size_t(a.width()), height = std::size_t(a.height());
  PixelValues values(width * height);
  oneapi::tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
    if (!needed.empty() && std::ranges::count(needed.subspan(width * y, width), 0) == int(width))
      return;
    std::vector<float> rgb_a(3 * width), rgb_b(rgb_a);
    a.fill(int(y), 0, rgb_a);
    b.fill(int(y), 0, rgb_b);
    kernel(rgb_a.data(), rgb_b.data(), values.data() + width * y, width);
    looked_at(width * sizeof(float));
  });
  return values;
}

void write_figures(const PixelValues& values, const MetricInput& input,
                   std::initializer_list<double> shares, std::span<double> figures) {
  const auto width = std::size_t(input.a.width());
  struct Row {
    double sum = 0, max = 0;
    std::size_t count = 0;
  };
  // A sum waits for its last addition, so a few rows are summed beside each other.
  constexpr std::size_t kBeside = 4;
  std::vector<Row> rows(std::size_t(input.a.height()));
  oneapi::tbb::parallel_for(
      std::size_t{0}, (rows.size() + kBeside - 1) / kBeside, [&](std::size_t part) {
        const std::size_t first = part * kBeside, count = std::min(kBeside, rows.size() - first);
        std::size_t pixels[kBeside];
        for (std::size_t i = 0; i < kBeside; ++i)
          pixels[i] = width * (first + std::min(i, count - 1));
        Row beside[kBeside];
        for (std::size_t x = 0; x < width; ++x)
          for (std::size_t i = 0; i < kBeside; ++i) {
            const std::size_t pixel = pixels[i] + x;
            if (!input.in_region(pixel)) continue;
            beside[i].sum += double(values[pixel]);
            beside[i].max = std::max(beside[i].max, double(values[pixel]));
            ++beside[i].count;
          }
        looked_at(count * width * sizeof(float));
        std::copy_n(beside, count, rows.begin() + std::ptrdiff_t(first));
      });
  Row all;
  for (const Row& row : rows)
    all = {all.sum + row.sum, std::max(all.max, row.max), all.count + row.count};
  std::ranges::fill(figures, 0.0);
  if (all.count == 0) return;
  std::vector<std::size_t> ranks;
  for (const double share : shares) ranks.push_back(rank_of(share, all.count));
  if (!ranks.empty())
    std::ranges::copy(nth_values(values, ranks, input.region), figures.begin() + 1);
  figures.front() = all.sum / double(all.count);
  figures.back() = all.max;
}

double percentile(std::span<const float> values, double share) {
  return double(nth_value(values, rank_of(share, values.size())));
}

std::vector<float> nth_values(std::span<const float> values, std::span<const std::size_t> ranks,
                              std::span<const std::uint8_t> region) {
  // Digit by digit, from the highest: no copy, and one pass over the values for each, for all ranks together. Few values
  // are counted with short digits: it would take longer to look at many counts.
  constexpr std::size_t kFew = std::size_t{1} << 18;
  const int most_bits = values.size() < kFew ? 11 : 16;
  struct Wanted {
    std::uint32_t found = 0;  ///< digits so far
    std::size_t rank;         ///< among the numbers that have them
  };
  std::vector<Wanted> wanted;
  for (const std::size_t rank : ranks) wanted.push_back({0, rank});
  std::uint32_t known = 0;
  for (int shift = 32; shift > 0;) {
    const int bits = std::min(most_bits, shift);
    shift -= bits;
    const std::size_t digits = std::size_t{1} << bits;
    std::vector<std::uint32_t> begins;  // of the numbers that are counted, each once
    for (const Wanted& one : wanted)
      if (std::ranges::count(begins, one.found) == 0) begins.push_back(one.found);
    const auto count_all = [shift](Counts& own, std::uint32_t number) { ++own[number >> shift]; };
    const auto count_begun = [&begins, known, shift, digits](Counts& own, std::uint32_t number) {
      for (std::size_t i = 0; i < begins.size(); ++i)
        if ((number & known) == begins[i]) ++own[digits * i + (number >> shift & (digits - 1))];
    };
    const Counts counts = known == 0
                              ? count_numbers(values, region, digits, count_all)
                              : count_numbers(values, region, digits * begins.size(), count_begun);
    for (Wanted& one : wanted) {
      const auto begin = std::size_t(std::ranges::find(begins, one.found) - begins.begin());
      std::uint32_t digit = 0;
      for (; one.rank >= counts[digits * begin + digit]; ++digit)
        one.rank -= counts[digits * begin + digit];
      one.found |= digit << shift;
    }
    known |= std::uint32_t(digits - 1) << shift;
  }
  std::vector<float> found;
  for (const Wanted& one : wanted) found.push_back(from_order(one.found));
  return found;
}

float nth_value(std::span<const float> values, std::size_t rank) {
  return nth_values(values, {&rank, 1})[0];
}

}  // namespace lobelia
