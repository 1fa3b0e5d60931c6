// Threads that each see to one process of an engine.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace lobelia {

/// Runs `work` on `count` threads to its end. What one of them throws sets `stop`, which the others look
/// at, and is thrown again here.
inline void run_workers(int count, std::atomic<bool>& stop, const std::function<void()>& work) {
  std::mutex mutex;
  std::exception_ptr first;
  {
    std::vector<std::jthread> pool;
    for (int i = 0; i < count; ++i)
      pool.emplace_back([&] {
        try {
          work();
        } catch (...) {
          const std::scoped_lock lock(mutex);
          if (!first) first = std::current_exception();
          stop = true;
        }
      });
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace lobelia
