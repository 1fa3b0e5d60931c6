// The states of a cell, in words and with a mark that needs no colour.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "base/records/outcome.hpp"

namespace lobelia::gallery {

/// Publishing finds the first four: the cell is not as the farm wrote it. The others are in farm.json, but for kKnown and
/// kNonFinite, which only a report has. The flaws, up to kChanged, are ordered from the worst.
enum class CellStatus {
  kDamaged,
  kLost,
  kChanged,
  kUnsealed,
  kPass,
  kDiffers,
  kUndecided,
  kFailed,
  kUnchecked,
  kMissing,
  kKnown,
  kNonFinite
};

/// All of them, in the order of counts and legends.
inline constexpr std::array<CellStatus, 12> kCellStatuses = {
    CellStatus::kPass,    CellStatus::kDamaged,   CellStatus::kLost,      CellStatus::kChanged,
    CellStatus::kDiffers, CellStatus::kKnown,     CellStatus::kUndecided, CellStatus::kNonFinite,
    CellStatus::kFailed,  CellStatus::kUnchecked, CellStatus::kMissing,   CellStatus::kUnsealed};

/// The worst first: a flaw is worse than a difference, and that than what is missing.
inline constexpr std::array<CellStatus, 12> kWorstFirst = {
    CellStatus::kDamaged,   CellStatus::kLost,    CellStatus::kChanged,   CellStatus::kFailed,
    CellStatus::kNonFinite, CellStatus::kDiffers, CellStatus::kUndecided, CellStatus::kUnsealed,
    CellStatus::kUnchecked, CellStatus::kMissing, CellStatus::kKnown,     CellStatus::kPass};
/// 0 for the worst.
constexpr int rank_of(CellStatus status) {
  return int(std::ranges::find(kWorstFirst, status) - kWorstFirst.begin());
}
/// A cell that passes, that is known to differ, or that was not compared or not done yet, needs no attention.
constexpr bool needs_a_look(CellStatus status) {
  return rank_of(status) < rank_of(CellStatus::kUnchecked);
}

/// Whether a file of the cell is not as the farm wrote it.
constexpr bool is_flaw(CellStatus status) { return status <= CellStatus::kChanged; }

struct StatusInfo {
  std::string_view name;     ///< "pass", as in records; also the class in style.css
  std::string_view word;     ///< "pass", for people
  std::string_view mark;     ///< "✓"
  std::string_view meaning;  ///< one sentence
};

const StatusInfo& info(CellStatus status);
/// In the words for what becomes of a pair, where a report may have the status.
StatusInfo info_of_pair(CellStatus status);
/// The status of a report's row, one of its pairs or a picture alone being so.
CellStatus status_of(records::Outcome outcome);
/// By its name in a farm's records; empty for any other name.
std::optional<CellStatus> find_status(std::string_view name);

}  // namespace lobelia::gallery
