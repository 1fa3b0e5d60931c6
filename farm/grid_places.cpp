#include "farm/grid_places.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace lobelia {
namespace {

/// Advances like a counter whose last digit runs fastest; false after the last.
bool count_on(std::vector<std::size_t>& digits, std::span<const std::size_t> sizes) {
  for (std::size_t i = digits.size(); i-- > 0;) {
    if (++digits[i] < sizes[i]) return true;
    digits[i] = 0;
  }
  return false;
}

}  // namespace

GridPlaces::GridPlaces(std::vector<GridFactor> factors) : factors_(std::move(factors)) {
  std::size_t count = 1;
  for (const auto& factor : factors_) count *= factor.size();
  excluded_.resize(count);
}

std::size_t GridPlaces::exclude(std::span<const std::vector<bool>> chosen) {
  // Only what is named is visited: a grid may have many exclusions of few cells each.
  std::vector<std::vector<std::size_t>> named;
  std::vector<std::size_t> sizes;
  std::size_t axis = 0, count = 1;
  for (const auto& factor : factors_) {
    auto& steps = named.emplace_back();
    for (std::size_t step = 0; step < factor.size(); ++step) {
      bool all = true;
      for (std::size_t i = 0; i < factor.steps.size(); ++i) {
        const auto& choices = chosen[axis + i];
        all = all && (choices.empty() || choices[factor.steps[i][step]]);
      }
      if (all) steps.push_back(step);
    }
    axis += factor.steps.size();
    sizes.push_back(steps.size());
    count *= steps.size();
  }
  if (count == 0) return 0;
  named_ += count;
  if (named_ > kMaxExcluded)
    throw std::runtime_error(
        fmt::format("the <exclude> elements name over {} cells together; allowed: {}", kMaxExcluded,
                    kMaxExcluded));
  std::vector<std::size_t> digits(factors_.size());
  do {
    std::size_t number = 0;
    for (std::size_t f = 0; f < factors_.size(); ++f)
      number = number * factors_[f].size() + named[f][digits[f]];
    excluded_[number] = true;
  } while (count_on(digits, sizes));
  return count;
}

std::vector<ValueIndex> GridPlaces::kept() const {
  std::vector<std::size_t> sizes;
  for (const auto& factor : factors_) sizes.push_back(factor.size());
  std::vector<ValueIndex> places;
  std::vector<std::size_t> digits(factors_.size());
  std::size_t number = 0;
  do {
    if (excluded_[number++]) continue;
    for (std::size_t f = 0; f < factors_.size(); ++f)
      for (const auto& steps : factors_[f].steps) places.push_back(steps[digits[f]]);
  } while (count_on(digits, sizes));
  return places;
}

}  // namespace lobelia
