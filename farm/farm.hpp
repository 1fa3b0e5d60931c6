// The farm: every cell of a grid rendered by us and by the reference engines, compared, and recorded
// as docs/records.md says. What the cache has is not made again.
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

/// More would make records that nobody reads (docs/scale.md); several farms may share a cache.
inline constexpr std::size_t kMaxFarmCells = 150000;

struct FarmOptions : JobRunOptions {
  std::filesystem::path cache;       ///< empty: DIRECTORY/cache
  JobFilter filter;                  ///< jobs that may be done
  bool again = false;                ///< make every one of them again
  bool require_engines = false;      ///< one that is absent is an error
  bool engines_as_recorded = false;  ///< nothing is made: what farm.json says of them holds
  std::vector<std::string> command;  ///< for the record
  /// Where whoever asked will publish what comes of it; a cluster's run has that done by its last element. Empty:
  /// nowhere.
  std::filesystem::path gallery;
};

struct FarmSummary {
  std::size_t cells = 0, pass = 0, differs = 0, failed = 0, missing = 0;
  std::size_t foreign = 0;                  ///< directories under cells/ that are not of this grid
  std::size_t undecided = 0;                ///< cells whose pictures are too noisy to tell
  std::size_t unchecked = 0;                ///< cells with no engine to compare with
  std::size_t rendered = 0, kept = 0;       ///< pictures
  std::size_t cached_cells = 0;             ///< of which everything was there
  double cached_seconds = 0;                ///< for looking at all cells, this program's own time
  std::vector<std::string> absent_engines;  ///< sentences: which, why, how to get it
  std::vector<std::string> refusals;        ///< sentences: which engine cannot show how many cells
  std::set<std::string> warnings;           ///< of the filter and the cells' highlights, each once
  std::vector<std::string> problems;        ///< "cell: engine: message", the first failures first
  JobRunWork work;
};

/// Throws Error(kInterrupted) on Ctrl-C, after farm.json has been written with what is done;
/// Error(kOutput) if the directory or the cache cannot be written; Error(kEngine), before anything is made or
/// changed, if an engine is broken (find_engines); Error(kInput) for more than kMaxFarmCells.
FarmSummary run_farm(const Grid& grid, const std::filesystem::path& directory,
                     const FarmOptions& options);

struct FarmPlan {
  std::size_t cells = 0, jobs = 0, wanted = 0;
  std::vector<std::string> absent_engines;
  std::string warning;  ///< of the filter; empty: none
};

/// What run_farm would do, in its order: calls `on_job` with the name of each job and why it is wanted ("missing",
/// "scene changed", "engine version changed: 3.8, was 3.7", ...). Writes nothing. What lies in the cache is believed by its
/// name; run_farm looks inside.
FarmPlan plan_farm(
    const Grid& grid, const std::filesystem::path& directory, const FarmOptions& options,
    const std::function<void(const std::string& name, const std::string& reason)>& on_job);

/// Where results are kept: `wanted`, else $LOBELIA_CACHE, else DIRECTORY/cache.
std::filesystem::path cache_directory(const std::filesystem::path& wanted,
                                      const std::filesystem::path& farm_directory);

}  // namespace lobelia
