// The one answer to "what is missing?": nothing else asks the cache whether a job has a result.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "farm/job_graph.hpp"
#include "farm/result_cache.hpp"

namespace lobelia {

enum class JobState : std::uint8_t {
  kAbsent,   ///< there is no such job, or it has no result and is not to be made
  kWaiting,  ///< to be made
  kDone,     ///< its result is in the cache
  kFailed,
  kBlocked,  ///< one of its inputs failed, or was taken away
};

/// Jobs that are to be made, and how closely results are looked at.
struct JobStateFilter {
  std::function<bool(JobIndex)> wanted =
      {};  ///< to be made if the result is missing; null: every job
  std::function<bool(JobIndex)> again = {};  ///< wanted though the result is there; null: none
  enum class Failures {
    kRetried,        ///< a kept failure changes nothing
    kOfOthersCount,  ///< it makes jobs kFailed that are not wanted
    kCount,          ///< it makes every job kFailed
  };
  Failures failures = Failures::kRetried;
  ResultCache::Look look = ResultCache::Look::kQuick;
};

/// The records of a cell's results, by place in the graph; null where there is no job or no result.
using CellRecords = std::vector<std::optional<records::Result>>;
CellRecords find_records(const JobGraph& graph, const ResultCache& cache, std::size_t cell,
                         ResultCache::Look look = ResultCache::Look::kQuick);

/// The record of one job's result. A comparison or a profile must be of the pictures that are in the cache now.
std::optional<records::Result> find_result(const JobGraph& graph, const ResultCache& cache,
                                           JobIndex job,
                                           ResultCache::Look look = ResultCache::Look::kQuick);

struct CellStates {
  std::vector<JobState> states;  ///< by place in the graph
  CellRecords records;
};

/// Leaves jobs of absent engines without a result out of the graph. No cache: nothing is there.
CellStates cell_states(JobGraph& graph, const ResultCache* cache, const JobStateFilter& filter,
                       std::size_t cell);

/// The same for all cells, on all processors. `on_cell` gets each, from any thread. Throws Error(kInterrupted).
std::vector<JobState> job_states(
    JobGraph& graph, const ResultCache* cache, const JobStateFilter& filter,
    const std::function<void(std::size_t cell, const CellStates&)>& on_cell = {});

}  // namespace lobelia
