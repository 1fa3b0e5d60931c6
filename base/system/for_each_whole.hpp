// A loop on many threads whose steps are whole, also when one of them fails.
#pragma once

#include <oneapi/tbb/parallel_for.h>

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>

namespace lobelia {

/// Calls step(i) for i = 0..count - 1. After the first exception no more steps begin, and it is thrown when those that
/// have begun are through. Without this, oneTBB ends the loops inside of other steps early: these go on with what is half
/// made.
template <class Step>
void for_each_whole(std::size_t count, const Step& step) {
  std::atomic<bool> failed = false;
  std::mutex mutex;
  std::exception_ptr first;
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    if (failed) return;
    try {
      step(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!first) first = std::current_exception();
      failed = true;
    }
  });
  if (first) std::rethrow_exception(first);
}

}  // namespace lobelia
