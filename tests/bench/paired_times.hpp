// Whether a change made something slower, from times of the old and the new that were taken in turn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

namespace lobelia {

struct PairedChange {
  enum class Verdict { kSlower, kFaster, kNoneFound };
  double ratio = 1;  ///< new over old, median of the pairs
  double least = 1,
         most = 1;  ///< the median is within them in more than 99.7 % of such measurements
  Verdict verdict = Verdict::kNoneFound;
};

/// Fewer pairs do not bound a median so surely.
inline constexpr std::size_t kLeastPairs = 10;

/// old_times[i] and new_times[i] were taken one after the other; all are positive. Bounds are order statistics of the
/// ratios, so they hold for any distribution: Conover, Practical Nonparametric Statistics, 3.2. Throws
/// std::invalid_argument with fewer than kLeastPairs pairs.
inline PairedChange paired_change(std::span<const double> old_times,
                                  std::span<const double> new_times) {
  const std::size_t n = old_times.size();
  if (n < kLeastPairs || new_times.size() != n)
    throw std::invalid_argument("too few pairs of times");
  std::vector<double> ratios(n);
  for (std::size_t i = 0; i < n; ++i) ratios[i] = new_times[i] / old_times[i];
  std::sort(ratios.begin(), ratios.end());
  // The largest rank below which less than 0.15 % of binomial(n, 1/2) lies.
  std::size_t rank = 0;
  double term = 1, sum = 0, all = 1;
  for (std::size_t i = 0; i < n; ++i) all *= 2;
  while ((sum + term) / all < 0.0015) {
    sum += term;
    term *= double(n - rank) / double(rank + 1);
    ++rank;
  }
  PairedChange change{ratios[n / 2], ratios[rank - 1], ratios[n - rank]};
  if (change.least > 1)
    change.verdict = PairedChange::Verdict::kSlower;
  else if (change.most < 1)
    change.verdict = PairedChange::Verdict::kFaster;
  return change;
}

}  // namespace lobelia
