// A cell's directory: the files of its results, as links into the cache, and cell.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "farm/job_states.hpp"
#include "records/farm.hpp"

namespace lobelia {

/// The record of a cell, in its directory.
inline constexpr char kCellRecordFile[] = "cell.json";

/// Why a cell has no result of an engine, or of ours.
struct CellProblem {
  records::CellProblem record;
  std::filesystem::path log;  ///< the engine's; empty: none
};

/// Whether a farm may have put a file of that name into a cell, cell.json included.
bool is_cell_file(const std::string& name);

/// Lets many farms be at work in a directory, or one command that removes cells.
class FarmDirectoryLock {
 public:
  enum class Use { kFarm, kAlone };
  /// Throws Error(kOutput) while others use it otherwise. With kLook nothing is written.
  FarmDirectoryLock(const std::filesystem::path& directory, Use use,
                    ByteLocks::Opening opening = ByteLocks::Opening::kMake);

 private:
  ByteLocks locks_;
  std::optional<ByteLocks::Claim> claim_;
};
inline constexpr char kFarmLockFile[] = "farm.lock";

class CellDirectory {
 public:
  CellDirectory(const std::filesystem::path& farm_directory, const JobGraph& graph,
                std::size_t cell);

  /// The status in cell.json. Empty unless that is of these results, without problems, and with the cache's files.
  std::string current_status(const ResultCache& cache, const CellRecords& records) const;

  /// Puts the results' files there, removes others, and writes cell.json last. Returns the status: "pass", "differs",
  /// "undecided" (too noisy to tell), "unchecked" (nothing to compare with), "failed" (there are problems) or "missing".
  /// Throws Error(kOutput), also where cells/ or the cell is a symbolic link.
  std::string write(const ResultCache& cache, const CellRecords& records,
                    const std::vector<CellProblem>& problems) const;

  /// Removes what a killed farm left half-written.
  void remove_abandoned() const;

  /// Removes cell.json, until the cell is written again.
  void forget() const;

  /// Why a result is wanted now, by the cell's record: "scene changed", "missing".
  std::string reason(JobIndex job) const;

 private:
  records::Named<std::string> results(const CellRecords& records) const;
  records::MadeFrom made_from() const;
  /// With the verdict of its comparisons; without problems.
  records::Cell cell_record(const CellRecords& records) const;
  HeldDirectory held() const;

  const JobGraph* graph_;
  std::size_t cell_;
  std::filesystem::path farm_directory_, directory_;
  mutable std::optional<std::optional<records::Cell>> before_;  ///< cell.json, once it was read
};

}  // namespace lobelia
