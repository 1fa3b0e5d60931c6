#include "cost/pareto.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace lobelia::cost {
namespace {

/// "1.8 times", "170 times", "1.3e+04 times", "infinitely many times"
std::string times_text(double ratio) {
  if (!std::isfinite(ratio)) return "infinitely many times";
  if (ratio >= 9999.5) return fmt::format("{:.2g} times", ratio);
  return fmt::format("{:.{}f} times", ratio, ratio < 9.95 ? 1 : 0);
}

double ratio(double more, double less) {
  if (less == 0) return more == 0 ? 1 : std::numeric_limits<double>::infinity();
  return more / less;
}

}  // namespace

double Way::setting(const std::string& wanted) const {
  for (const auto& [key, value] : settings)
    if (key == wanted) return std::strtod(value.c_str(), nullptr);
  return std::numeric_limits<double>::quiet_NaN();
}

int clearly_slower(const Way& a, const Way& b) {
  const double noise = a.time.spread * a.time.median + b.time.spread * b.time.median;
  const double difference = b.time.median - a.time.median;
  return difference > noise ? 1 : difference < -noise ? -1 : 0;
}

Front pareto_front(const Table& table, std::size_t error) {
  const auto& ways = table.ways;
  Front front;
  front.dominated_by.assign(ways.size(), kNone);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (!std::isnan(ways[i].errors[error])) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    if (ways[i].time.median != ways[j].time.median)
      return ways[i].time.median < ways[j].time.median;
    return ways[i].errors[error] < ways[j].errors[error];
  });
  for (const std::size_t i : order) {
    if (!front.ways.empty() && ways[front.ways.back()].errors[error] <= ways[i].errors[error]) {
      // The fastest that is as accurate: what one would take instead.
      front.dominated_by[i] = *std::find_if(
          front.ways.begin(), front.ways.end(),
          [&](std::size_t f) { return ways[f].errors[error] <= ways[i].errors[error]; });
      continue;
    }
    front.ways.push_back(i);
  }
  return front;
}

std::vector<std::string> front_sentences(const Table& table, std::size_t error) {
  const Front front = pareto_front(table, error);
  const auto& ways = table.ways;
  const std::string cost = table.is_timed() ? "time" : table.unit;
  std::vector<std::string> sentences;
  for (std::size_t i = 1; i < front.ways.size(); ++i) {
    const Way &from = ways[front.ways[i - 1]], &to = ways[front.ways[i]];
    sentences.push_back(fmt::format("from {} to {}: {} the {}, {} less error", from.name, to.name,
                                    times_text(ratio(to.time.median, from.time.median)), cost,
                                    times_text(ratio(from.errors[error], to.errors[error]))));
  }
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (front.dominated_by[i] == kNone) continue;
    const Way &better = ways[front.dominated_by[i]], &way = ways[i];
    const double more = ratio(way.errors[error], better.errors[error]);
    sentences.push_back(fmt::format(
        "{} takes {} the {} of {} and has {}", way.name,
        times_text(ratio(way.time.median, better.time.median)), cost, better.name,
        more < 1.005 ? std::string("its error") : fmt::format("{} its error", times_text(more))));
  }
  return sentences;
}

}  // namespace lobelia::cost
