// The states of a cell, in words and with a mark that needs no colour.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace lobelia::gallery {

/// Publishing finds the first four: the cell is not as the farm wrote it. The others are in farm.json.
/// The flaws, up to kChanged, are ordered from the worst.
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
  kMissing
};

/// All of them, in the order of counts and legends.
inline constexpr std::array<CellStatus, 10> kCellStatuses = {
    CellStatus::kPass,    CellStatus::kDamaged,   CellStatus::kLost,   CellStatus::kChanged,
    CellStatus::kDiffers, CellStatus::kUndecided, CellStatus::kFailed, CellStatus::kUnchecked,
    CellStatus::kMissing, CellStatus::kUnsealed};

/// The worst first: a flaw is worse than a difference, and that than what is missing.
inline constexpr std::array<CellStatus, 10> kWorstFirst = {
    CellStatus::kDamaged, CellStatus::kLost,      CellStatus::kChanged,  CellStatus::kFailed,
    CellStatus::kDiffers, CellStatus::kUndecided, CellStatus::kUnsealed, CellStatus::kUnchecked,
    CellStatus::kMissing, CellStatus::kPass};
/// 0 for the worst.
constexpr int rank_of(CellStatus status) {
  return int(std::ranges::find(kWorstFirst, status) - kWorstFirst.begin());
}
/// A cell that passes, or that was not compared or not done yet, needs no attention.
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
  std::string_view of_pair;  ///< the same of a report's pair, for states that it may have
};

const StatusInfo& info(CellStatus status);
/// By its name in a farm's records; empty for any other name.
std::optional<CellStatus> find_status(std::string_view name);

}  // namespace lobelia::gallery
