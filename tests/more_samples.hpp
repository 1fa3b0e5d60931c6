#pragma once

#include <cstddef>
#include <cstdlib>

namespace lobelia {

/// LOBELIA_TEST_SAMPLES, or 1: tests of what is random take so many times their samples. With more samples a bias shows
/// that noise hides.
inline int more_samples() {
  const char* text = std::getenv("LOBELIA_TEST_SAMPLES");
  const int times = text ? std::atoi(text) : 1;
  return times >= 1 && times <= 64 ? times : 1;
}

/// Whether to skip this case: the short suite runs every third case of a long list, the long suite runs them all.
inline bool is_left_out(std::size_t number) { return more_samples() == 1 && number % 3 != 0; }

}  // namespace lobelia
