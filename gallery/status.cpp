#include "gallery/status.hpp"

namespace lobelia::gallery {

const StatusInfo& info(CellStatus status) {
  static constexpr StatusInfo kPass{
      "pass", "pass", "✓",
      "Our picture agrees with every engine that is there, within the limits."};
  static constexpr StatusInfo kDiffers{
      "differs", "differs", "≠",
      "All pictures are there, but at least one number is over its limit."};
  static constexpr StatusInfo kUndecided{
      "undecided", "undecided", "±",
      "No difference was found, but the pictures have noise that could hide one: more samples are needed."};
  static constexpr StatusInfo kFailed{"failed", "failed", "✕",
                                      "A picture could not be rendered, or could not be compared."};
  static constexpr StatusInfo kUnchecked{"unchecked", "not compared", "○",
                                         "Rendered by us; no other engine was there."};
  static constexpr StatusInfo kMissing{
      "missing", "not done", "…",
      "Not done yet: the farm was stopped before it came to this cell."};
  static constexpr StatusInfo kDamaged{
      "damaged", "damaged", "!",
      "A picture or a record cannot be read, or has pixels that are not finite."};
  static constexpr StatusInfo kLost{"lost", "missing", "∅",
                                    "A picture or a record that the farm wrote is not there."};
  static constexpr StatusInfo kChanged{
      "changed", "changed", "Δ",
      "A picture or a record is another one than the farm wrote: its hash differs."};
  static constexpr StatusInfo kUnsealed{
      "unsealed", "not sealed", "?",
      "Its record is of an earlier version, without hashes: nothing tells whether its pictures are those that were "
      "judged. The farm’s command writes it anew."};
  switch (status) {
    case CellStatus::kDamaged:
      return kDamaged;
    case CellStatus::kLost:
      return kLost;
    case CellStatus::kChanged:
      return kChanged;
    case CellStatus::kUnsealed:
      return kUnsealed;
    case CellStatus::kPass:
      return kPass;
    case CellStatus::kDiffers:
      return kDiffers;
    case CellStatus::kUndecided:
      return kUndecided;
    case CellStatus::kFailed:
      return kFailed;
    case CellStatus::kUnchecked:
      return kUnchecked;
    case CellStatus::kMissing:
      break;
  }
  return kMissing;
}

std::optional<CellStatus> find_status(std::string_view name) {
  for (const CellStatus status : kCellStatuses) {
    if (status > CellStatus::kUnsealed && info(status).name == name) return status;
  }
  return std::nullopt;
}

}  // namespace lobelia::gallery
