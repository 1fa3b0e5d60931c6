// How many threads work: as many as the user wants and the system allows.
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace lobelia {

/// So few pixels are rendered, or packed for a file, in about the time that oneTBB needs to start: one thread does all.
inline constexpr std::size_t kPixelsOfOneThread = std::size_t{256} * 256;

/// How many threads could be started just now, at most `wanted`. Starts them and ends them again, because no limit tells
/// how much of it is left.
int startable_threads(int wanted) noexcept;

/// Threads for work, including the calling one: one for each processor, or fewer if the system does not allow as many as
/// our libraries start then. Looks once.
int usual_threads() noexcept;

/// Limits oneTBB to usual_threads(), because it ends the process if it cannot start a thread. For good: without the limit
/// it would start more, even while the process ends. Called before oneTBB is used: by each command
/// (program/command/main.cpp), by the libraries' functions, and by a ThreadLimit.
void keep_to_usual_threads();

/// Runs work on `threads` threads, including the calling one; 0 is one for each processor. Fewer if the system does not
/// allow as many.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : arena_(threads > 0 ? threads : oneapi::tbb::task_arena::automatic) {
    keep_to_usual_threads();
    // Asked for more threads than processors, oneTBB warns on stderr and gives fewer.
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

}  // namespace lobelia
