// The state of each job. Nothing else asks the cache whether a job has a result.
#pragma once

#include "farm/job_graph.hpp"
#include "farm/result_cache.hpp"

namespace lobelia {

enum class JobState : std::uint8_t {
  kAbsent,   ///< no such job, or no result and not to be made
  kWaiting,  ///< to be made
  kDone,     ///< its result is in the cache
  kFailed,
  kBlocked,  ///< one of its inputs failed or was removed
};

/// Which jobs are to be made, and how closely results are checked.
struct JobStateFilter {
  std::function<bool(JobIndex)> wanted = {};  ///< made if the result is missing; null: every job
  std::function<bool(JobIndex)> again = {};   ///< made even if the result is there; null: none
  enum class Failures {
    kRetried,        ///< kept failures are ignored
    kOfOthersCount,  ///< jobs that are not wanted are kFailed after one
    kCount,          ///< all jobs are
  };
  Failures failures = Failures::kRetried;
  ResultCache::Look look = ResultCache::Look::kQuick;
};

/// The records of a cell's results, by place in the graph; null without a job or a result.
using CellRecords = std::vector<std::optional<records::Result>>;
CellRecords find_records(const JobGraph& graph, const ResultCache& cache, std::size_t cell,
                         ResultCache::Look look = ResultCache::Look::kQuick);

/// The record of one job's result. A comparison or a profile has to be of the pictures in the cache.
std::optional<records::Result> find_result(const JobGraph& graph, const ResultCache& cache,
                                           JobIndex job,
                                           ResultCache::Look look = ResultCache::Look::kQuick);

struct CellStates {
  std::vector<JobState> states;  ///< by place in the graph
  CellRecords records;
};

/// Drops jobs of absent engines without a result from the graph. No cache: no results.
CellStates cell_states(JobGraph& graph, const ResultCache* cache, const JobStateFilter& filter,
                       std::size_t cell);

/// The same for all cells, on all processors. `on_cell` gets each, from any thread. Throws Error(kInterrupted).
std::vector<JobState> job_states(
    JobGraph& graph, const ResultCache* cache, const JobStateFilter& filter,
    const std::function<void(std::size_t cell, const CellStates&)>& on_cell = {});

}  // namespace lobelia
