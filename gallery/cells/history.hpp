// Earlier runs of a grid, and the cells of this one in them.
#pragma once

#include "gallery/cells/change.hpp"

namespace lobelia::gallery {

struct EarlierRun {
  std::filesystem::path directory;
  std::string name;  ///< of its directory
  std::string date;  ///< "2026-11-20": when its farm.json was written
  ShownFarm farm;
  std::vector<std::optional<std::size_t>> match;  ///< by cell of the new run: the same cell here
};

struct History {
  std::string date;  ///< of the new run
  std::vector<EarlierRun>
      runs;  ///< the oldest first; the last is the baseline; empty: there is none

  bool empty() const { return runs.empty(); }
  const EarlierRun& baseline() const { return runs.back(); }
  /// "2026-11-20 (nightly)"
  std::string since() const;
  /// Cells of the baseline that the new run does not have.
  std::vector<const CellEntry*> gone() const;
};

/// Throws Error(kInput) if a directory has no farm.json that can be read, or a link in place of it; Error(kUsage) if it
/// is the run itself.
History read_history(const std::filesystem::path& run, const ShownFarm& farm,
                     const std::vector<std::filesystem::path>& earlier);

/// The cells of `earlier` that have the same value on every axis as each cell of `now`, whatever the order of the axes.
/// Where no cell has, a value that is a path counts by its last part: grids in other folders name the same files.
/// Several such cells are told apart by their ids.
std::vector<std::optional<std::size_t>> match_cells(const records::Farm& now,
                                                    const records::Farm& earlier);

/// The main metric of an engine in one run.
struct TimePoint {
  std::string date, name;  ///< of the run
  std::optional<double> value, limit;
  std::string verdict;  ///< in words
};

struct Timeline {
  std::string engine, metric;
  std::vector<TimePoint> points;  ///< the oldest first; the last is of the new run
};

struct CellHistory {
  CellChange change;
  std::vector<Timeline> timelines;    ///< by engine that has a main metric
  std::optional<CheckedCell> before;  ///< of the baseline
};

/// Reads the cell's records in every earlier run, with the checks of check_cell(). A cell with a link in it is damaged.
CellHistory history_of(const History& history, const ShownFarm& farm, std::size_t index,
                       const CheckedCell& cell);

}  // namespace lobelia::gallery
