// A cell's directory in a farm's: the files of its results, as links into the cache, and cell.json.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "farm/job_states.hpp"
#include "records/farm.hpp"

namespace lobelia {

/// Why a cell has no result of an engine, or of ours.
struct CellProblem {
  records::CellProblem record;
  std::filesystem::path log;  ///< the engine's; empty: it had nothing to say
};

/// Whether a farm may have put a file of that name into a cell, cell.json included.
bool is_cell_file(const std::string& name);

/// Of a farm's directory, while it lives: many farms may be at work there, or one that takes cells away.
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

  /// The status in cell.json, if that is of these results, without problems, and every file is still the one in the
  /// cache; otherwise empty.
  std::string current_status(const ResultCache& cache, const CellRecords& records) const;

  /// Puts the results' files there, takes away what is of others, and writes cell.json last. Returns the
  /// status: "pass", "differs", "undecided" (none differs, and a comparison is up to the noise), "unchecked" (nothing to compare with),
  /// "failed" (if there are problems) or "missing" (something has not been done). Throws Error(kOutput), also where
  /// cells/ or the cell is a symbolic link.
  std::string write(const ResultCache& cache, const CellRecords& records,
                    const std::vector<CellProblem>& problems) const;

  /// Removes what a killed farm left half-written there.
  void remove_abandoned() const;

  /// Takes cell.json away, until the cell is written again.
  void forget() const;

  /// What made the cell that is there, as far as it has a record: why a result is wanted now. As few
  /// words: "scene changed", "engine version changed: 3.7.0.10, was 3.7.0.8", "missing".
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
  mutable std::optional<std::optional<records::Cell>>
      before_;  ///< cell.json, once it was asked for
};

}  // namespace lobelia
