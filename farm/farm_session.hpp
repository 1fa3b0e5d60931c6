// A farm at work on a grid: what is there, what is to be made, and the state of each cell. Who does the jobs, this
// machine or a cluster, is not its business.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "farm/cell_directory.hpp"
#include "farm/farm.hpp"
#include "farm/farm_engines.hpp"
#include "farm/job_graph.hpp"
#include "farm/result_cache.hpp"

namespace lobelia {

/// A grid's cells with the engines that are here. Not copied: its parts refer to each other.
struct FarmWork {
  /// `directory` is the farm's, for its record of engines that are absent now.
  FarmWork(const Grid& g, const FarmOptions& options, const std::filesystem::path& directory = {});
  FarmWork(const FarmWork&) = delete;
  std::vector<std::string> absences() const;  ///< a sentence for each absent engine
  std::vector<std::string> refusals() const;  ///< for each engine, of cells that it cannot show
  /// The jobs that the options ask for, of those that can be made here.
  JobStateFilter filter(const FarmOptions& options) const;
  /// A sentence if there are jobs and the filter picks none of them, else empty.
  std::string filter_warning(const JobFilter& filter) const;

  const Grid& grid;
  const FarmCells cells;
  const std::vector<FarmEngine> engines;
  JobGraph graph;
};

class FarmSession {
 public:
  /// Opens the cache, looks at every cell, writes those that are complete, and writes farm.json.
  /// Arguments must outlive it. Throws as run_farm().
  FarmSession(const Grid& grid, const std::filesystem::path& directory, const FarmOptions& options);

  FarmWork& work() { return work_; }
  const ResultCache& cache() const { return cache_; }
  /// As it found the jobs: kDone where the result is there, kWaiting where it is to be made.
  const std::vector<JobState>& states() const { return states_; }
  /// Cells with jobs that are waiting, from coarse to fine.
  const std::vector<std::size_t>& waiting_cells() const { return waiting_cells_; }

  /// Writes a cell with what is there now and what has failed. From any thread.
  void finish_cell(std::size_t cell);
  /// After an early end: writes every cell that has something, and farm.json.
  void show_what_is_there();
  void write_farm_record() const;
  FarmSummary summarise(const JobRunWork& done);
  /// Whether results were made and are gone before their cell was written or a job read them.
  bool has_lost(const JobRun& run) const;

 private:
  CellDirectory cell_directory(std::size_t cell) const {
    return CellDirectory(directory_, work_.graph, cell);
  }
  void look_at_cells();
  bool look_at(std::size_t cell, const CellStates& found);
  bool is_to_be_made(const std::string& cell, const std::string& job) const;
  void take_warnings(const CellRecords& records);
  std::size_t count_foreign_cells() const;

  FarmWork work_;
  const std::filesystem::path directory_;
  const FarmOptions& options_;
  const FarmDirectoryLock directory_in_use_;
  const ResultCache cache_;
  const ByteLocks::Claim in_use_;
  const LockSharing lock_sharing_;
  std::vector<JobState> states_;
  std::vector<std::size_t> waiting_cells_;
  mutable std::mutex mutex_;         // of what follows
  std::vector<std::string> status_;  ///< by cell
  FarmSummary summary_;
};

}  // namespace lobelia
