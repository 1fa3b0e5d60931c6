// The farm: renders every cell of a grid with Lobelia and the reference engines, unless the cache has it, and compares them.
#pragma once

#include "farm/job_run.hpp"

namespace lobelia {

/// See docs/scale.md; several farms may share a cache.
inline constexpr std::size_t kMaxFarmCells = 150000;

struct FarmOptions : JobRunOptions {
  std::filesystem::path cache;       ///< empty: DIRECTORY/cache
  JobFilter filter;                  ///< jobs that may be done
  bool again = false;                ///< makes all of these again
  bool require_engines = false;      ///< an absent engine is an error
  bool engines_as_recorded = false;  ///< makes nothing, and takes the engines from farm.json
  Leave leave;                       ///< the user's, for what the grid says
  std::vector<std::string> command;  ///< for the record
  std::filesystem::path
      gallery;  ///< the caller, or a cluster's last element, publishes there; empty: nowhere
};

/// The numbers of cells by status, and more.
struct FarmSummary : records::StatusCounts {
  std::size_t cells = 0;
  std::size_t foreign = 0;                  ///< directories under cells/ that are not of this grid
  std::size_t rendered = 0, kept = 0;       ///< pictures
  std::size_t cached_cells = 0;             ///< cells with all results in the cache
  double cached_seconds = 0;                ///< time to look at all cells
  std::vector<std::string> absent_engines;  ///< a sentence each: which, why, how to get it
  std::vector<std::string> refusals;  ///< a sentence for each engine that cannot show some cells
  std::set<std::string> warnings;     ///< of the filter and the cells' highlights, each once
  std::vector<std::string> problems;  ///< "cell: engine: message", the first failures first
  JobRunWork work;
};

/// Throws Error: kInterrupted on Ctrl-C, after writing farm.json; kOutput if the directory or the cache cannot be written;
/// before any change kUsage without leave for what the grid starts or reads, kEngine if an engine is broken, and kInput for
/// more than kMaxFarmCells.
FarmSummary run_farm(const Grid& grid, const std::filesystem::path& directory,
                     const FarmOptions& options);

struct FarmPlan {
  std::size_t cells = 0, jobs = 0, wanted = 0;
  std::vector<std::string> absent_engines;
  std::string warning;  ///< of the filter; empty: none
};

/// Calls `on_job` with each job that run_farm would do, in its order, and why: "missing", "scene changed", "engine version
/// changed: 3.8, was 3.7". Writes nothing, and does not look inside results.
FarmPlan plan_farm(
    const Grid& grid, const std::filesystem::path& directory, const FarmOptions& options,
    const std::function<void(const std::string& name, const std::string& reason)>& on_job);

/// The cache: `wanted`, else $LOBELIA_CACHE, else DIRECTORY/cache.
std::filesystem::path cache_directory(const std::filesystem::path& wanted,
                                      const std::filesystem::path& farm_directory);

}  // namespace lobelia
