// How many threads work, where the user says so.
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "core/thread_count.hpp"

namespace lobelia {

/// Runs work on `threads` threads, the calling one among them; 0 is one for each processor. Fewer where the system does
/// not allow as many.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : arena_(threads > 0 ? threads : oneapi::tbb::task_arena::automatic) {
    // oneTBB warns on stderr and gives fewer if more than the processors are asked for.
    if (threads > oneapi::tbb::info::default_concurrency())
      more_.emplace(oneapi::tbb::global_control::max_allowed_parallelism,
                    std::size_t(1 + startable_threads(threads - 1)));
  }
  template <class Work>
  void run(Work&& work) {
    arena_.execute(std::forward<Work>(work));
  }

 private:
  std::optional<oneapi::tbb::global_control> more_;
  oneapi::tbb::task_arena arena_;
};

/// Keeps oneTBB to usual_threads(), because it ends the process where it cannot start a thread. For good: once it may
/// have more it starts them, also as the process ends.
inline void keep_to_usual_threads() {
  if (usual_threads() >= oneapi::tbb::info::default_concurrency()) return;
  static const auto* const fewer = new oneapi::tbb::global_control(
      oneapi::tbb::global_control::max_allowed_parallelism, std::size_t(usual_threads()));
  static_cast<void>(fewer);
}

}  // namespace lobelia
