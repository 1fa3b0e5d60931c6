// The states of a cell, in words and with a mark that needs no colour.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace lobelia::gallery {

/// As in farm.json, and kUnreadable for a cell whose own record cannot be read.
enum class CellStatus { kPass, kDiffers, kUndecided, kFailed, kUnchecked, kMissing, kUnreadable };

inline constexpr std::array<CellStatus, 7> kCellStatuses = {
    CellStatus::kPass,      CellStatus::kDiffers,    CellStatus::kUndecided, CellStatus::kFailed,
    CellStatus::kUnchecked, CellStatus::kUnreadable, CellStatus::kMissing};

struct StatusInfo {
  std::string_view name;     ///< "pass", as in records; also the class in style.css
  std::string_view word;     ///< "pass", for people
  std::string_view mark;     ///< "✓"
  std::string_view meaning;  ///< one sentence
};

const StatusInfo& info(CellStatus status);
/// By the name that records use; empty if it is not one of them.
std::optional<CellStatus> find_status(std::string_view name);

}  // namespace lobelia::gallery
