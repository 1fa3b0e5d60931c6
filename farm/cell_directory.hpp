// A cell's directory: the files of its results, as links into the cache, and cell.json.
#pragma once

#include "farm/group_flush.hpp"
#include "farm/job_states.hpp"

namespace lobelia {

inline constexpr char kCellRecordFile[] = "cell.json";

/// Why a cell lacks the result of an engine, or ours.
struct CellProblem {
  records::CellProblem record;
  std::filesystem::path log;  ///< of the engine; empty: none
};

/// Whether farms put files of that name into a cell: results of the catalogue's engines and of `outside` ones, and
/// cell.json.
bool is_cell_file(const std::string& name, const std::set<std::string>& outside);

/// Admits several farms to a directory, or one command that removes cells.
class FarmDirectoryLock {
 public:
  enum class Use { kFarm, kAlone };
  /// Throws Error(kOutput) during the other use. Writes nothing with kLook.
  FarmDirectoryLock(const std::filesystem::path& directory, Use use,
                    ByteLocks::Opening opening = ByteLocks::Opening::kMake);

 private:
  ByteLocks locks_;
  std::optional<ByteLocks::Claim> claim_;
};

class CellDirectory {
 public:
  CellDirectory(const std::filesystem::path& farm_directory, const JobGraph& graph,
                std::size_t cell);

  /// The status in cell.json; empty unless it is about these results, without problems, and the cache's files are in place.
  std::string current_status(const ResultCache& cache, const CellRecords& records) const;

  /// Puts the results' files there, removes old ones, and writes cell.json last, by `flush`: then `on_status` gets the
  /// status, "pass", "differs", "undecided" (too noisy to tell), "unchecked" (nothing to compare with), "failed" (there are
  /// problems) or "missing". Throws Error(kOutput), also if cells/ or the cell is a symbolic link.
  void write(const ResultCache& cache, const CellRecords& records,
             const std::vector<CellProblem>& problems, GroupFlush& flush,
             std::function<void(const std::string& status)> on_status) const;

  /// Removes half-written files of killed farms.
  void remove_abandoned() const;

  /// Removes cell.json, until the cell is written again.
  void forget() const;

  /// Why a result has to be made, by the cell's record: "scene changed", "missing".
  std::string reason(JobIndex job) const;

 private:
  records::Named<std::string> results(const CellRecords& records) const;
  records::MadeFrom made_from() const;
  std::set<std::string> outside_engines() const;
  /// With the verdict of its comparisons; without problems.
  records::Cell cell_record(const CellRecords& records) const;
  HeldDirectory held() const;

  const JobGraph* graph_;
  std::size_t cell_;
  std::filesystem::path farm_directory_, directory_;
  mutable std::optional<std::optional<records::Cell>>
      before_;  ///< cell.json, once it has been read
};

}  // namespace lobelia
