#include <fmt/format.h>

#include "base/words/numbers.hpp"
#include "gallery/cells/cell_page.hpp"
#include "gallery/pages/index_page.hpp"

namespace lobelia::gallery {
namespace {

EngineFigure figure(const ShownFarm& farm, const records::FarmEngine& engine,
                    const CheckedCell& cell) {
  EngineFigure result{farm.short_title(engine), "–", ""};
  const CheckedComparison* comparison = cell.find_comparison(engine.name);
  if (!comparison && cell.has_record) result.worst = "none";
  if (comparison && comparison->doubt) result.worst = info(*comparison->doubt).word;
  if (!comparison || comparison->doubt) return result;
  if (comparison->verdict == "non-finite")
    result.worst = "non-finite";
  else if (const auto worst = comparison->metric("max_rel_peak"))
    result.worst = percent_text(*worst, TrailingZeros::kKeep);
  const double outliers = comparison->metric("outliers").value_or(0);
  if (outliers > 0) result.note = count_text(outliers) + " px";
  return result;
}

std::vector<std::string> reasons_of(const ShownFarm& farm, const CheckedCell& cell) {
  std::vector<std::string> reasons;
  if (!cell.unreadable.empty()) reasons.push_back(cell.unreadable);
  for (const Flaw& flaw : cell.flaws) reasons.push_back(flaw.message);
  for (const std::string& sentence : cell.contradictions) reasons.push_back(sentence);
  if (cell.status == CellStatus::kUnsealed)
    reasons.emplace_back("cell.json has no hashes of its files");
  for (const records::CellProblem& problem : cell.record.problems) {
    const std::string who = problem.engine.empty() ? "" : farm.engine_title(problem.engine) + ": ";
    reasons.push_back(who + problem.message);
  }
  for (const records::NotComparable& one : cell.record.not_comparable)
    reasons.push_back(farm.engine_title(one.engine) + ": not comparable, because " + one.because);
  for (const CheckedComparison& comparison : cell.comparisons) {
    const bool is_named = farm.record.engines.size() > 2 || !farm.is_report;
    const std::string pair =
        is_named ? farm.engine_title(cell.other_of(comparison)) + " · " : std::string();
    if (!comparison.sentence.empty()) reasons.push_back(pair + comparison.sentence);
    if (comparison.verdict == "non-finite") reasons.push_back(pair + "pixels that are not finite");
    for (const std::string& reason : broken_limits(farm, comparison))
      reasons.push_back(pair + reason);
  }
  return reasons;
}

}  // namespace

records::Named<double> limits_of(const records::Comparison& comparison) {
  records::Named<double> limits;
  if (comparison.tolerance)
    limits.emplace_back("max_rel_peak",
                        comparison.tolerance->relative + comparison.tolerance->of_peak);
  for (const records::Limit& limit : comparison.limits) {
    std::erase_if(limits, [&](const auto& one) { return one.first == limit.metric; });
    limits.emplace_back(limit.metric, limit.limit);
  }
  return limits;
}

std::vector<std::string> broken_limits(const ShownFarm& farm, const CheckedComparison& comparison) {
  std::vector<std::string> sentences;
  for (const records::Limit& limit : comparison.record.limits)
    if (!limit.pass)
      sentences.push_back(fmt::format("{}: {}, limit {}", farm.metrics.info(limit.metric).title,
                                      farm.metrics.text(limit.metric, limit.value),
                                      farm.metrics.text(limit.metric, limit.limit)));
  return sentences;
}

CellSummary summarise(const ShownFarm& farm, const CellEntry& entry, const CheckedCell& cell) {
  CellSummary summary;
  summary.entry = &entry;
  summary.status = cell.status;
  summary.is_as_written =
      !is_flaw(cell.status) && cell.status != CellStatus::kUnsealed && cell.contradictions.empty();
  if (const EnginePicture* ours = cell.find_image(farm.hub)) {
    summary.picture = ours->png;
    if (!cell.thumbnail.file.empty()) summary.picture.small = cell.thumbnail;
  }
  for (const records::FarmEngine& engine : farm.record.engines) {
    if (engine.name == farm.hub || !engine.available) continue;
    summary.figures.push_back(figure(farm, engine, cell));
    if (!farm.is_report) continue;
    if (const EnginePicture* theirs = cell.find_image(engine.name))
      summary.beside.push_back(theirs->png);
    if (const CheckedComparison* comparison = cell.find_comparison(engine.name))
      summary.beside.push_back(comparison->png);
  }
  for (const CheckedComparison& comparison : cell.comparisons) {
    if ((comparison.entry.a != farm.hub && comparison.entry.b != farm.hub) || comparison.doubt)
      continue;
    records::Named<double> numbers;
    for (const auto& metric : comparison.record.metrics)
      if (!is_coordinate(metric.first)) numbers.push_back(metric);
    summary.metrics.emplace_back(cell.other_of(comparison), std::move(numbers));
    summary.limits.emplace_back(cell.other_of(comparison), limits_of(comparison.record));
    const double* limit = records::find(summary.limits.back().second, "max_rel_peak");
    const auto difference = comparison.metric("max_rel_peak");
    if (!limit || !difference) continue;
    const NearestToLimit one{cell.other_of(comparison), *difference, *limit, comparison.png};
    if (summary.nearest.engine.empty() || one.share() > summary.nearest.share())
      summary.nearest = one;
  }
  if (summary.status != CellStatus::kPass) summary.reasons = reasons_of(farm, cell);
  return summary;
}

CellSummary publish_with_history(const ShownFarm& farm, const History& history,
                                 const CellEntry& entry, const CheckedCell& cell,
                                 const std::function<void(std::optional<CellHistory>&)>& write) {
  std::optional<CellHistory> past;
  if (!history.empty())
    past = history_of(history, farm, std::size_t(&entry - farm.cells.data()), cell);
  write(past);
  CellSummary summary = summarise(farm, entry, cell);
  if (past) summary.change = std::move(past->change);
  return summary;
}

}  // namespace lobelia::gallery
