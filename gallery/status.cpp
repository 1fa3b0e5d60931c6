#include "gallery/status.hpp"

namespace lobelia::gallery {
namespace {

/// In the order of CellStatus.
constexpr StatusInfo kInfos[] = {
    {"damaged", "damaged", "!",
     "A picture or a record cannot be read, or has pixels that are not finite.", ""},
    {"lost", "missing", "∅", "A picture or a record that the farm wrote is not there.", ""},
    {"changed", "changed", "Δ",
     "A picture or a record is another one than the farm wrote: its hash differs.", ""},
    {"unsealed", "not sealed", "?",
     "Its record is of an earlier version, without hashes: nothing tells whether its pictures are those that were "
     "judged. The farm’s command writes it anew.",
     ""},
    {"pass", "pass", "✓", "Our picture agrees with every engine that is there, within the limits.",
     "The pictures agree within the limits."},
    {"differs", "differs", "≠",
     "All pictures are there, but at least one number is over its limit.",
     "At least one number is over its limit."},
    {"undecided", "undecided", "±",
     "No difference was found, but the pictures have noise that could hide one: more samples are needed.",
     "The noise leaves it open whether they differ: more samples are needed."},
    {"failed", "failed", "✕", "A picture could not be rendered, or could not be compared.",
     "A picture cannot be read, or the two cannot be compared."},
    {"unchecked", "not compared", "○", "Rendered by us; no other engine was there.",
     "There is no reference for it."},
    {"missing", "no picture", "…",
     "Not done yet: the farm was stopped before it came to this cell.",
     "There is only a reference."}};
static_assert(std::size(kInfos) == kCellStatuses.size());

}  // namespace

const StatusInfo& info(CellStatus status) { return kInfos[int(status)]; }

std::optional<CellStatus> find_status(std::string_view name) {
  for (const CellStatus status : kCellStatuses)
    if (status > CellStatus::kUnsealed && info(status).name == name) return status;
  return std::nullopt;
}

}  // namespace lobelia::gallery
