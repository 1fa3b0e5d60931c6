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

/// Of a long list of cases one in three is enough for the short suite; with more samples all of them.
inline bool is_left_out(std::size_t number) { return more_samples() == 1 && number % 3 != 0; }

}  // namespace lobelia
