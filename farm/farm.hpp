// The farm: renders every cell of a grid with Lobelia and the reference engines, and compares them. What the cache has
// is not made again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "farm/grid.hpp"
#include "farm/job.hpp"
#include "farm/job_run.hpp"

namespace lobelia {

/// See docs/scale.md; several farms may share a cache.
inline constexpr std::size_t kMaxFarmCells = 150000;

struct FarmOptions : JobRunOptions {
  std::filesystem::path cache;       ///< empty: DIRECTORY/cache
  JobFilter filter;                  ///< jobs that may be done
  bool again = false;                ///< make every one of them again
  bool require_engines = false;      ///< one that is absent is an error
  bool engines_as_recorded = false;  ///< nothing is made: what farm.json says of them holds
  std::vector<std::string> command;  ///< for the record
  /// Where the caller will publish the outcome; a cluster's run has its last element do it. Empty: nowhere.
  std::filesystem::path gallery;
};

struct FarmSummary {
  std::size_t cells = 0, pass = 0, differs = 0, failed = 0, missing = 0;
  std::size_t foreign = 0;                  ///< directories under cells/ that are not of this grid
  std::size_t undecided = 0;                ///< cells with too much noise to tell
  std::size_t unchecked = 0;                ///< cells with no engine to compare with
  std::size_t rendered = 0, kept = 0;       ///< pictures
  std::size_t cached_cells = 0;             ///< everything was there
  double cached_seconds = 0;                ///< for looking at all cells
  std::vector<std::string> absent_engines;  ///< sentences: which, why, how to get it
  std::vector<std::string> refusals;        ///< sentences: which engine cannot show how many cells
  std::set<std::string> warnings;           ///< of the filter and the cells' highlights, each once
  std::vector<std::string> problems;        ///< "cell: engine: message", the first failures first
  JobRunWork work;
};

/// Throws Error: kInterrupted on Ctrl-C, after farm.json has been written; kOutput if the directory or the cache cannot
/// be written; kEngine, before anything is changed, if an engine is broken; kInput for more than kMaxFarmCells.
FarmSummary run_farm(const Grid& grid, const std::filesystem::path& directory,
                     const FarmOptions& options);

struct FarmPlan {
  std::size_t cells = 0, jobs = 0, wanted = 0;
  std::vector<std::string> absent_engines;
  std::string warning;  ///< of the filter; empty: none
};

/// Calls `on_job` with each job that run_farm would do, in its order, and why: "missing", "scene changed", "engine version
/// changed: 3.8, was 3.7". Writes nothing, and does not look inside the results.
FarmPlan plan_farm(
    const Grid& grid, const std::filesystem::path& directory, const FarmOptions& options,
    const std::function<void(const std::string& name, const std::string& reason)>& on_job);

/// Where results are kept: `wanted`, else $LOBELIA_CACHE, else DIRECTORY/cache.
std::filesystem::path cache_directory(const std::filesystem::path& wanted,
                                      const std::filesystem::path& farm_directory);

}  // namespace lobelia
