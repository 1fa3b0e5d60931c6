// Does jobs on this machine, as many at a time as keep its processors busy.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "farm/chunk_report.hpp"
#include "farm/job_states.hpp"
#include "reference_scenes/failure.hpp"

namespace lobelia {

struct FarmProgress {
  std::size_t done = 0, total = 0;  ///< jobs
  std::string running;              ///< "render 108/108, povray 17/108"
};

struct JobRunOptions {
  std::map<std::string, std::filesystem::path> programs;  ///< in place of those in $PATH, by engine
  int threads = 0;                                        ///< 0: all processors
  std::chrono::duration<double> time_limit = std::chrono::minutes(10);        ///< for each picture
  std::chrono::duration<double> no_progress_limit = std::chrono::minutes(5);  ///< of an engine
  int attempts = 3;        ///< at a picture that fails in a way that may not repeat itself
  bool fail_fast = false;  ///< the first failure ends it
  /// Bytes that a job's processes may use together; a job that lacks memory is tried once more with twice as much.
  /// 0: any number, of both.
  std::uint64_t memory = std::uint64_t{4} << 30;
  std::uint64_t disk = std::uint64_t{4} << 30;  ///< bytes that an engine may write for a job
  /// Pictures in a row, at all attempts, after which a failing engine is not tried any more. 0: it always is.
  int give_up_after = 5;
  bool leave_undone = false;  ///< its other jobs then are for another machine; otherwise they fail
  std::filesystem::path failed_directory;                ///< FailedJobs; empty: none
  std::function<void(const FarmProgress&)> on_progress;  ///< from any thread, one at a time
};

struct JobRunWork {
  std::size_t made = 0;       ///< results, by this run
  std::size_t pictures = 0;   ///< of these: renders and references
  std::size_t found = 0;      ///< somebody else made them meanwhile
  std::size_t different = 0;  ///< likewise, with other pixels
  std::size_t lost = 0;       ///< jobs not done because somebody took results or the cache away
  std::size_t undone = 0;     ///< left for another machine
  std::vector<LeftUndone> engines_given_up;
  double wall_seconds = 0;
  double engine_cpu_seconds = 0;  ///< of all their processes
  double kernel_cpu_seconds = 0;  ///< for pictures, comparisons and profiles of our own
  double own_cpu_seconds = 0;     ///< of this process besides
  int processors = 0;
  /// Share of the processors' time that engines and kernels had.
  double busy() const {
    return wall_seconds > 0 && processors > 0
               ? (engine_cpu_seconds + kernel_cpu_seconds) / (wall_seconds * processors)
               : 0;
  }
};

class JobBoard;
class JobMaker;

class JobRun {
 public:
  /// `states` as job_states() has them. Results that others share the cache for are made once: who comes second waits
  /// for the first.
  JobRun(JobGraph& graph, const ResultCache& cache, const JobRunOptions& options,
         std::vector<JobState> states);
  ~JobRun();

  /// Does all that is waiting, cells in this order. Calls `on_cell`, from any thread, when nothing of a cell is waiting
  /// any more, or a failure in it has ended the run. The cache keeps failures of jobs. Throws Error(kInterrupted) on
  /// Ctrl-C, Error(kOutput) if results cannot be kept.
  void run(const std::vector<std::size_t>& order, const std::function<void(std::size_t)>& on_cell);

  JobState state(JobIndex job) const;
  const JobRunWork& work() const;

 private:
  void make_results();

  JobGraph& graph_;
  const JobRunOptions& options_;
  std::unique_ptr<JobBoard> board_;
  std::unique_ptr<JobMaker> maker_;
};

}  // namespace lobelia
