// How many threads work, where the user says so.
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <optional>
#include <utility>

namespace lobelia {

/// Runs work on `threads` threads, the calling one among them; 0 is one for each processor.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : arena_(threads > 0 ? threads : oneapi::tbb::task_arena::automatic) {
    // oneTBB warns on stderr and gives fewer if more than the processors are asked for.
    if (threads > oneapi::tbb::info::default_concurrency())
      more_.emplace(oneapi::tbb::global_control::max_allowed_parallelism, std::size_t(threads));
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
