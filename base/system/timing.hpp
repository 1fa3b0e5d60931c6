// Timing in rounds: each round runs every case once, so that changes of the machine's speed affect all cases alike. The
// median counts, and the spread says how far to trust it.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace lobelia {

struct Times {
  double least = 0, median = 0, most = 0;  ///< seconds
  /// Half of the spread between quartiles, relative to the median.
  double spread = 0;
  int rounds = 0;
};

inline double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The least of a few runs of something that returns its seconds: without what interrupts it.
inline double least_seconds(int runs, const std::function<double()>& seconds) {
  double least = seconds();
  for (int run = 1; run < runs; ++run) least = std::min(least, seconds());
  return least;
}

/// The time of the second of two runs, whose caches do not depend on what ran before.
inline double warm_seconds(const std::function<void()>& work) {
  work();
  return seconds_of(work);
}

inline Times summary(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  const std::size_t n = seconds.size();
  const double median = seconds[n / 2];
  return {seconds.front(), median, seconds.back(),
          (seconds[n * 3 / 4] - seconds[n / 4]) / 2 / median, int(n)};
}

/// Times each case once in each round, after one warm-up.
inline std::vector<Times> interleaved(const std::vector<std::function<void()>>& cases, int rounds) {
  std::vector<std::vector<double>> seconds(cases.size());
  for (const auto& work : cases) work();
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < cases.size(); ++i) seconds[i].push_back(seconds_of(cases[i]));
  std::vector<Times> result;
  for (auto& s : seconds) result.push_back(summary(std::move(s)));
  return result;
}

/// Times of one of `parts` equal parts of the work, such as one evaluation of a million.
inline Times per(const Times& times, double parts) {
  return {times.least / parts, times.median / parts, times.most / parts, times.spread,
          times.rounds};
}

}  // namespace lobelia
