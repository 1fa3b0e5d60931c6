#pragma once

#include <cstdlib>

namespace lobelia {

/// LOBELIA_TEST_SAMPLES, or 1: tests of what is random take so many times their samples. With more samples a bias shows
/// that noise hides.
inline int more_samples() {
  const char* text = std::getenv("LOBELIA_TEST_SAMPLES");
  const int times = text ? std::atoi(text) : 1;
  return times >= 1 && times <= 64 ? times : 1;
}

}  // namespace lobelia
