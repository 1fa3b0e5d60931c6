// Runs several tasks at a time that mostly wait, each on a thread of its own.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace lobelia {

/// Calls f(0) to f(count - 1), up to `most` at once including the calling thread; fewer if the system starts no more
/// threads. After the first exception no further call begins and `stop` is called, which may make the others end sooner.
/// Once they have ended, the exception is thrown again.
inline void for_each_at_once(std::size_t count, int most, const std::function<void(std::size_t)>& f,
                             const std::function<void()>& stop = {}) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr first;
  const auto work = [&] {
    try {
      for (std::size_t i; (i = next++) < count;) f(i);
    } catch (...) {
      next = count;
      const std::scoped_lock lock(mutex);
      if (first) return;
      first = std::current_exception();
      if (stop) stop();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (std::size_t i = 1; i < std::min(count, std::size_t(std::max(most, 1))); ++i)
        others.emplace_back(work);
    } catch (const std::system_error&) {  // no more threads
    }
    work();
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace lobelia
