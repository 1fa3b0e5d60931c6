#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gallery/cells/checked_cell.hpp"

namespace lobelia::gallery {
namespace {

enum class Standing { kHolds, kOpen, kBroken };

bool is_noisy(const records::Limit& limit) { return !limit.standing.empty(); }

/// Where noise is known, the value may be anywhere in its error bar.
Standing standing_of(const records::Comparison& comparison, const records::Limit& limit,
                     bool more_is_better) {
  const double* measured = records::find(comparison.metrics, limit.metric);
  const double value = measured ? *measured : limit.value;
  if (limit.metric == "z.open") return value <= limit.limit ? Standing::kHolds : Standing::kOpen;
  double low = value, high = value;
  if (is_noisy(limit) && comparison.error_bars)
    if (const auto* bar = records::find(*comparison.error_bars, limit.metric))
      low = bar->low, high = bar->high;
  if (std::isnan(value) || std::isnan(low) || std::isnan(high))
    return is_noisy(limit) ? Standing::kOpen : Standing::kBroken;
  // A signed figure is the better the nearer it is to 0.
  const auto holds = [&](double at) {
    return more_is_better ? at >= limit.limit : std::abs(at) <= limit.limit;
  };
  const bool low_holds = holds(low), high_holds = holds(high);
  if (low_holds && high_holds) return Standing::kHolds;
  return low_holds || high_holds || (low < 0 && high > 0) ? Standing::kOpen : Standing::kBroken;
}

/// Whether some engine's picture has neither a comparison nor a reason why there is none.
bool lacks_a_comparison(const CheckedCell& cell) {
  return std::ranges::any_of(cell.images, [&](const EnginePicture& image) {
    return image.engine != cell.hub && !cell.find_comparison(image.engine) &&
           std::ranges::find(cell.record.not_comparable, image.engine,
                             &records::NotComparable::engine) == cell.record.not_comparable.end();
  });
}

CellStatus judged_status(const CheckedCell& cell, CellStatus recorded) {
  if (!cell.record.problems.empty()) return CellStatus::kFailed;
  if (recorded == CellStatus::kMissing || lacks_a_comparison(cell)) return CellStatus::kMissing;
  int worst = -1;
  for (const CheckedComparison& comparison : cell.comparisons)
    worst = std::max(worst, rank(comparison.verdict));
  return worst < 0    ? CellStatus::kUnchecked
         : worst == 0 ? CellStatus::kPass
         : worst == 1 ? CellStatus::kUndecided
                      : CellStatus::kDiffers;
}

/// A flaw of the comparison's record or of one of its two pictures; null if there is none.
const Flaw* flaw_behind(const CheckedCell& cell, const CheckedComparison& comparison) {
  const auto is_behind = [&](const Flaw& flaw) {
    if (flaw.file == comparison.entry.record) return true;
    for (const std::string& engine : {comparison.entry.a, comparison.entry.b})
      if (flaw.file == engine + ".exr" || flaw.file == engine + "-error.exr") return true;
    return false;
  };
  const auto at = std::ranges::find_if(cell.flaws, is_behind);
  return at == cell.flaws.end() ? nullptr : &*at;
}

}  // namespace

int rank(const std::string& verdict) {
  if (verdict == "pass" || verdict == "same") return 0;
  return verdict == "undecided" ? 1 : verdict == "differs" || verdict == "different" ? 2 : 3;
}

std::size_t rank(CellStatus status) {
  constexpr std::array kOrder = {CellStatus::kPass,      CellStatus::kUnchecked,
                                 CellStatus::kUndecided, CellStatus::kDiffers,
                                 CellStatus::kMissing,   CellStatus::kFailed};
  return std::size_t(std::ranges::find(kOrder, status) - kOrder.begin());
}

std::string judge(const records::Comparison& comparison, const Metrics& metrics) {
  if (comparison.nonfinite.a > 0 || comparison.nonfinite.b > 0) return "non-finite";
  bool noisy = false;
  Standing worst = comparison.limits.empty() ? Standing::kBroken : Standing::kHolds;
  for (const records::Limit& limit : comparison.limits) {
    noisy = noisy || is_noisy(limit);
    worst =
        std::max(worst, standing_of(comparison, limit, metrics.info(limit.metric).more_is_better));
  }
  if (worst == Standing::kHolds) return noisy ? "same" : "pass";
  return worst == Standing::kOpen && noisy ? "undecided" : noisy ? "different" : "differs";
}

void judge_cell(CheckedCell& cell, const Metrics& metrics) {
  const auto contradict = [&](const std::string& record, std::string_view said,
                              std::string_view found) {
    cell.contradictions.push_back(
        fmt::format("{} says “{}”, but its figures say “{}”.", record, said, found));
  };
  for (CheckedComparison& comparison : cell.comparisons) {
    if (const Flaw* flaw = flaw_behind(cell, comparison)) comparison.doubt = flaw->status;
    if (!comparison.problem.empty()) continue;
    const std::string judged = judge(comparison.record, metrics);
    if (rank(judged) == rank(comparison.verdict)) continue;
    contradict(comparison.entry.record, comparison.verdict, judged);
    if (rank(judged) > rank(comparison.verdict)) comparison.verdict = judged;
  }
  const CellStatus recorded = cell.status, judged = judged_status(cell, recorded);
  if (cell.flaws.empty() && judged != recorded)
    contradict("cell.json", info(recorded).word, info(judged).word);
  if (rank(judged) > rank(recorded)) cell.status = judged;
  if (cell.status == CellStatus::kPass && !cell.is_sealed) cell.status = CellStatus::kUnsealed;
  for (const Flaw& flaw : cell.flaws)
    if (!is_flaw(cell.status) || flaw.status < cell.status) cell.status = flaw.status;
}

}  // namespace lobelia::gallery
