// Does jobs on this machine, as many at a time as keep its processors busy.
#pragma once

#include <chrono>

#include "base/records/cluster.hpp"
#include "farm/group_flush.hpp"
#include "farm/job_states.hpp"

namespace lobelia {

struct FarmProgress {
  std::size_t done = 0, total = 0;  ///< jobs
  std::string running;              ///< "render 108/108, povray 17/108"
};

struct JobRunOptions {
  ProgramPaths programs;
  int threads = 0;                                                            ///< 0: all processors
  std::chrono::duration<double> time_limit = std::chrono::minutes(10);        ///< for each picture
  std::chrono::duration<double> no_progress_limit = std::chrono::minutes(5);  ///< of an engine
  int attempts = 3;        ///< at a picture, if the failure may not repeat itself
  bool fail_fast = false;  ///< the first failure ends the run
  /// Bytes that a job's processes may use together; 0: no limit. A job that lacks memory is tried again with twice as much.
  std::uint64_t memory = std::uint64_t{4} << 30;
  std::uint64_t disk = std::uint64_t{4}
                       << 30;  ///< bytes that an engine may write for a job; 0: no limit
  int give_up_after =
      5;  ///< pictures in a row that fail at all attempts end an engine's use; 0: never
  bool leave_undone =
      false;  ///< leaves that engine's other jobs to another machine; otherwise they fail
  std::filesystem::path failed_directory;                ///< FailedJobs; empty: none
  std::function<void(const FarmProgress&)> on_progress;  ///< from any thread, one at a time
};

struct JobRunWork {
  std::size_t made = 0;       ///< results of this run
  std::size_t pictures = 0;   ///< of these, renders and references
  std::size_t found = 0;      ///< results that another process made meanwhile
  std::size_t different = 0;  ///< of these, results with other pixels
  std::size_t lost = 0;       ///< jobs not done because results or the cache were removed
  std::size_t undone = 0;     ///< jobs left for another machine
  std::vector<records::LeftUndone> engines_given_up;
  double wall_seconds = 0;
  double engine_cpu_seconds = 0;  ///< all processes of engines
  double kernel_cpu_seconds = 0;  ///< our own pictures, comparisons and profiles
  double own_cpu_seconds = 0;     ///< everything else in this process
  int processors = 0;
  /// The share of the processors' time that engines and kernels used.
  double busy() const {
    return wall_seconds > 0 && processors > 0
               ? (engine_cpu_seconds + kernel_cpu_seconds) / (wall_seconds * processors)
               : 0;
  }
};

/// Does all waiting jobs of `states` (see job_states()), cells in this order. Results that others make in the same cache are
/// waited for. Calls `on_cell`, from any thread, once a cell has nothing left to wait for, or a failure in it ended the run;
/// it may write into `directory`. The cache keeps failures of jobs. Throws Error(kInterrupted) on Ctrl-C, Error(kOutput) if
/// results cannot be kept.
JobRunWork run_jobs(JobGraph& graph, const ResultCache& cache, const JobRunOptions& options,
                    std::vector<JobState>& states, const std::vector<std::size_t>& order,
                    const std::filesystem::path& directory,
                    const std::function<void(std::size_t cell, GroupFlush&)>& on_cell);

}  // namespace lobelia
