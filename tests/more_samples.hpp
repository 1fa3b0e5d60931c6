#pragma once

#include <cstddef>
#include <cstdlib>
#include <vector>

namespace lobelia {

/// LOBELIA_TEST_SAMPLES, or 1: tests of what is random take so many times their samples. With more samples a bias shows
/// that noise hides.
inline int more_samples() {
  const char* text = std::getenv("LOBELIA_TEST_SAMPLES");
  const int times = text ? std::atoi(text) : 1;
  return times >= 1 && times <= 64 ? times : 1;
}

/// Whether to skip this case: the short suite runs one of `every` cases of a long list, the long suite runs them all.
inline bool is_left_out(std::size_t number, std::size_t every = 3) {
  return more_samples() == 1 && number % every != 0;
}

/// Those of a list that are not left out.
template <typename List>
auto some_of(const List& all, std::size_t every = 3) {
  std::vector<typename List::value_type> some;
  std::size_t number = 0;
  for (const auto& one : all)
    if (!is_left_out(number++, every)) some.push_back(one);
  return some;
}

}  // namespace lobelia
