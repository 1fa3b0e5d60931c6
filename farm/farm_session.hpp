// A farm at work on a grid, here or on a cluster: which results are there, which are to be made, and each cell's state.
#pragma once

#include <mutex>

#include "farm/cell_directory.hpp"
#include "farm/farm.hpp"

namespace lobelia {

/// A grid's cells with the engines that are here. Cannot be copied: its parts refer to each other.
struct FarmWork {
  /// `directory` is the farm's: its record lists engines that are absent now.
  FarmWork(const Grid& g, const FarmOptions& options, const std::filesystem::path& directory = {});
  FarmWork(const FarmWork&) = delete;
  std::vector<std::string> absences() const;  ///< a sentence for each absent engine
  /// The jobs that the options ask for and that can be made here.
  JobStateFilter filter(const FarmOptions& options) const;
  /// A sentence if the filter picks none of the jobs; otherwise empty.
  std::string filter_warning(const JobFilter& filter) const;

  const Grid& grid;
  const FarmCells cells;
  const std::vector<FarmEngine> engines;
  JobGraph graph;
};

class FarmSession {
 public:
  /// Looks at every cell, writes the complete ones and farm.json. Arguments must outlive it. Throws as run_farm().
  FarmSession(const Grid& grid, const std::filesystem::path& directory, const FarmOptions& options);

  FarmWork& work() { return work_; }
  const ResultCache& cache() const { return cache_; }
  /// The state of each job at the start: kDone if the result is there, kWaiting if it is to be made.
  const std::vector<JobState>& states() const { return states_; }
  /// Cells with waiting jobs, from coarse to fine.
  const std::vector<std::size_t>& waiting_cells() const { return waiting_cells_; }

  /// Writes a cell with its results and failures so far. From any thread.
  void finish_cell(std::size_t cell, GroupFlush& flush);
  /// After an early end: writes every cell with results or failures, and farm.json.
  void show_what_is_there();
  void write_farm_record() const;
  FarmSummary summarise(const JobRunWork& done);
  /// Whether all jobs of a cell have ended (`states`), and a result or what failed was not there when the cell was written.
  bool has_lost(const std::vector<JobState>& states) const;

 private:
  CellDirectory cell_directory(std::size_t cell) const {
    return CellDirectory(directory_, work_.graph, cell);
  }
  void look_at_cells();
  bool look_at(std::size_t cell, const CellStates& found, GroupFlush& flush);
  void write_cell(std::size_t cell, const CellRecords& records,
                  const std::vector<CellProblem>& problems, GroupFlush& flush);
  void take_warnings(const CellRecords& records);

  FarmWork work_;
  const std::filesystem::path directory_;
  const FarmOptions& options_;
  const FarmDirectoryLock directory_in_use_;
  const ResultCache cache_;
  const ByteLocks::Claim in_use_;
  const LockSharing lock_sharing_;
  std::vector<JobState> states_;
  std::vector<std::size_t> waiting_cells_;
  mutable std::mutex mutex_;         // of the following
  std::vector<std::string> status_;  ///< by cell
  FarmSummary summary_;
};

}  // namespace lobelia
