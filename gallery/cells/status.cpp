#include "gallery/cells/status.hpp"

namespace lobelia::gallery {
namespace {

using records::Outcome;

/// In the order of CellStatus.
constexpr StatusInfo kInfos[] = {
    {"damaged", "damaged", "!",
     "A picture or a record cannot be read, or has pixels that are not finite."},
    {"lost", "missing", "∅", "A picture or a record that the farm wrote is not there."},
    {"changed", "changed", "Δ",
     "A picture or a record is another one than the farm wrote: its hash differs."},
    {"unsealed", "not sealed", "?",
     "Its record is of an earlier version, without hashes: nothing tells whether its pictures are those that were "
     "judged. The farm’s command writes it anew."},
    {"pass", "pass", "✓", "Our picture agrees with every engine that is there, within the limits."},
    {"differs", "differs", "≠",
     "All pictures are there, but at least one number is over its limit."},
    {"undecided", "undecided", "±",
     "No difference was found, but the pictures have noise that could hide one: more samples are needed."},
    {"failed", "failed", "✕", "A picture could not be rendered, or could not be compared."},
    {"unchecked", "not compared", "○", "Rendered by us; no other engine was there."},
    {"missing", "no picture", "…",
     "Not done yet: the farm was stopped before it came to this cell."},
    {"known", "known", "≈", records::info(Outcome::kKnown).meaning},
    {"non-finite", "non-finite", "✕", records::info(Outcome::kNonFinite).meaning}};
static_assert(std::size(kInfos) == kCellStatuses.size());

/// In the order of Outcome.
constexpr std::array<CellStatus, records::kOutcomes> kStatuses = {
    CellStatus::kPass,      CellStatus::kDiffers,  CellStatus::kKnown,   CellStatus::kUndecided,
    CellStatus::kNonFinite, CellStatus::kFailed,   CellStatus::kMissing, CellStatus::kFailed,
    CellStatus::kFailed,    CellStatus::kUnchecked};

}  // namespace

const StatusInfo& info(CellStatus status) { return kInfos[int(status)]; }

CellStatus status_of(Outcome outcome) { return kStatuses[std::size_t(outcome)]; }

StatusInfo info_of_pair(CellStatus status) {
  StatusInfo words = info(status);
  for (std::size_t i = 0; i < records::kOutcomes; ++i) {
    const records::OutcomeInfo& outcome = records::kOutcomeInfos[i];
    if (status_of(Outcome(i)) != status) continue;
    words.word = outcome.name;
    words.meaning = outcome.meaning;
    break;
  }
  return words;
}

std::optional<CellStatus> find_status(std::string_view name) {
  for (const CellStatus status : kCellStatuses)
    if (status > CellStatus::kUnsealed && info(status).name == name) return status;
  return std::nullopt;
}

}  // namespace lobelia::gallery
