#include "core/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace lobelia {
namespace {

double round_step(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double share = rough / power;
  return power * (share <= 1 ? 1 : share <= 2 ? 2 : share <= 5 ? 5 : 10);
}

}  // namespace

std::vector<Tick> linear_ticks(double from, double to, int count) {
  std::vector<Tick> ticks;
  if (!(to > from) || count < 1) return ticks;
  const double step = round_step((to - from) / count);
  // Counted in whole steps, so that 0.1 + 0.2 is written as 0.3.
  const double first = std::ceil(from / step - 1e-9), last = std::floor(to / step + 1e-9);
  for (double i = first; i <= last && ticks.size() < 100; ++i) {
    const double value = i == 0 ? 0 : i * step;
    ticks.push_back({value, number_text(value)});
  }
  return ticks;
}

std::vector<Tick> log_ticks(double from, double to) {
  std::vector<Tick> ticks;
  if (!(from > 0) || !(to > from)) return ticks;
  const int first = static_cast<int>(std::floor(std::log10(from) - 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(to) + 1e-9));
  const int every = std::max(1, (last - first + 7) / 8);
  for (int power = first; power <= last; ++power) {
    const double base = std::pow(10.0, power);
    for (int digit = 1; digit <= (every == 1 ? 9 : 1); ++digit) {
      const double value = digit * base;
      if (value < from * (1 - 1e-9) || value > to * (1 + 1e-9)) continue;
      const bool labelled = digit == 1 && power % every == 0;
      ticks.push_back({value, labelled ? power_of_ten_text(power) : ""});
    }
  }
  return ticks;
}

double round_up(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  const double step = round_step(value / 5);
  return step * std::ceil(value / step - 1e-9);
}

}  // namespace lobelia
