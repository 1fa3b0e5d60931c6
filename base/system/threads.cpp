#include "base/system/threads.hpp"

#include <cstdlib>
#include <exception>
#include <latch>
#include <thread>
#include <vector>

namespace lobelia {
namespace {

/// oneTBB's and our own: each may have a thread for each processor.
constexpr int kPools = 2;
/// Threads and processes beside them: the watcher of interrupts, the process that decodes pictures, an engine.
constexpr int kSpare = 4;

}  // namespace

int startable_threads(int wanted) noexcept {
  int started = 0;
  try {
    std::latch end(1);
    std::vector<std::jthread> threads;
    threads.reserve(std::size_t(wanted));
    try {
      for (; started < wanted; ++started)
        threads.emplace_back([&end] {
          // The C library reserves memory for a thread at its first allocation.
          std::free(std::malloc(1));
          end.wait();
        });
    } catch (const std::exception&) {  // the limit is reached
    }
    end.count_down();
  } catch (const std::exception&) {
  }
  return started;
}

int usual_threads() noexcept {
  static const int count = [] {
    const int processors = std::max(1, int(std::thread::hardware_concurrency()));
    return std::clamp((startable_threads(kPools * processors + kSpare) - kSpare) / kPools, 1,
                      processors);
  }();
  return count;
}

void keep_to_usual_threads() {
  static const auto* const fewer =
      usual_threads() < oneapi::tbb::info::default_concurrency()
          ? new oneapi::tbb::global_control(oneapi::tbb::global_control::max_allowed_parallelism,
                                            std::size_t(usual_threads()))
          : nullptr;
  static_cast<void>(fewer);
}

}  // namespace lobelia
