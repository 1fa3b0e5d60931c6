#include <fmt/format.h>

#include <algorithm>

#include "base/records/words.hpp"
#include "base/words/numbers.hpp"
#include "gallery/cells/cell_page.hpp"

namespace lobelia::gallery {
namespace {

/// Ids of all metrics, in the order of the records.
std::vector<std::string> metric_ids(const CheckedCell& cell) {
  std::vector<std::string> ids;
  const auto add = [&](const std::string& id) {
    if (!is_coordinate(id) && std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
  };
  for (const CheckedComparison& comparison : cell.comparisons) {
    for (const auto& [id, value] : comparison.record.metrics) add(id);
    for (const records::Limit& limit : comparison.record.limits) add(limit.metric);
  }
  return ids;
}

std::string value_text(const ShownFarm& farm, const CheckedComparison& comparison,
                       const std::string& id) {
  const auto value = comparison.metric(id);
  if (!value) return "–";
  std::string words = farm.metrics.text(id, *value);
  const auto x = comparison.metric(id + ".x"), y = comparison.metric(id + ".y");
  if (x && y) words += " at (" + count_text(*x) + ", " + count_text(*y) + ")";
  return words;
}

std::string limit_text(const ShownFarm& farm, const CheckedComparison& comparison,
                       const std::string& id) {
  std::string words;
  for (const records::Limit& limit : comparison.record.limits) {
    if (limit.metric != id) continue;
    words += limit.pass                 ? "✓ within "
             : limit.standing == "open" ? "± on either side of "
                                        : "≠ over ";
    words += farm.metrics.text(id, limit.limit);
  }
  return words;
}

void write_metric_row(Html& html, const ShownFarm& farm, const CheckedCell& cell,
                      const std::string& id) {
  const MetricInfo metric = farm.metrics.info(id);
  const Tag row(html, "tr");
  {
    const Tag head(html, "th", {{"scope", "row"}});
    html.text(metric.title);
    if (!metric.meaning.empty()) html.element("small", metric.meaning);
  }
  for (const CheckedComparison& comparison : cell.comparisons) {
    const Tag value(html, "td", {{"class", "number"}});
    html.text(value_text(farm, comparison, id));
    const auto& bars = comparison.record.error_bars;
    if (const auto* bar = bars ? records::find(*bars, id) : nullptr)
      html.element("small", "from " + farm.metrics.text(id, bar->low) + " to " +
                                farm.metrics.text(id, bar->high) +
                                " without noise; noise alone shows " +
                                farm.metrics.text(id, bar->noise_floor));
    const std::string limit = limit_text(farm, comparison, id);
    if (limit.empty()) continue;
    html.element("small", {{"class", limit.starts_with("≠") ? "over" : "within"}}, limit);
  }
}

void write_words_row(Html& html, const CheckedCell& cell, const std::string& head,
                     std::string (*words)(const CheckedComparison&)) {
  const Tag row(html, "tr");
  html.element("th", {{"scope", "row"}}, head);
  for (const CheckedComparison& comparison : cell.comparisons)
    html.element("td", words(comparison));
}

std::string tolerance_text(const CheckedComparison& comparison) {
  if (!comparison.record.tolerance) return "none";
  const records::Tolerance& t = *comparison.record.tolerance;
  std::string words;
  const auto add = [&](const std::string& part) { words += (words.empty() ? "" : " + ") + part; };
  if (t.relative != 0) add(percent_text(t.relative) + " of the value");
  if (t.of_peak != 0) add(percent_text(t.of_peak) + " of the peak");
  if (words.empty()) words = "exactly equal";
  if (t.allowed_outliers != 0)
    words += ", but for " + count_text(double(t.allowed_outliers)) + " pixels";
  return words;
}

std::string nonfinite_text(const CheckedComparison& comparison) {
  const records::Nonfinite& nonfinite = comparison.record.nonfinite;
  return count_text(double(nonfinite.a)) + " in the first, " + count_text(double(nonfinite.b)) +
         " in the second";
}

std::string viewing_text(const CheckedComparison& comparison) {
  if (!comparison.problem.empty()) return std::string();
  const records::Viewing& seen = comparison.record.viewing;
  std::string words =
      fmt::format("exposure {} stops, {} pixels per degree", number_text(seen.exposure_stops, 6),
                  number_text(seen.pixels_per_degree, 6));
  const auto add = [&](const char* what, const auto& part) {
    if (part) words += fmt::format(", {} {}", what, in_words(*part));
  };
  add("HDR exposures", seen.hdr_exposures);
  add("display", seen.display);
  return words;
}

}  // namespace

std::string verdict_words(const CheckedComparison& comparison) {
  if (comparison.doubt)
    return fmt::format("{} {}", info(*comparison.doubt).mark, info(*comparison.doubt).word);
  if (!comparison.problem.empty()) return comparison.problem;
  const std::string& verdict = comparison.verdict;
  if (verdict == "pass" || verdict == "same") return "✓ " + verdict;
  if (verdict == "differs" || verdict == "different") return "≠ " + verdict;
  if (verdict == "undecided") return "± " + verdict;
  return "✕ " + (verdict.empty() ? "no verdict" : verdict);
}

void write_numbers(Html& html, const ShownFarm& farm, const CheckedCell& cell) {
  const Tag section(html, "section", {{"aria-labelledby", "numbers"}});
  html.element("h2", {{"id", "numbers"}}, "The numbers");
  if (cell.comparisons.empty())
    return write_absence(html, farm.is_report
                                   ? "The pictures could not be compared."
                                   : "Our picture was compared with no other: no reference "
                                     "picture was there.");
  const Tag wrap(html, "div", {{"class", "table-wrap"}, {"tabindex", "0"}});
  const Tag table(html, "table", {{"class", "metrics"}});
  std::vector<std::string> titles = {"Measure"};
  for (const CheckedComparison& comparison : cell.comparisons)
    titles.push_back(farm.engine_title(comparison.entry.a) + " and " +
                     farm.engine_title(comparison.entry.b));
  write_columns(html, titles);
  const Tag tbody(html, "tbody");
  write_words_row(html, cell, "Verdict", verdict_words);
  write_words_row(html, cell, "Pixels that are not finite", nonfinite_text);
  write_words_row(html, cell, "Tolerance of each pixel", tolerance_text);
  for (const std::string& id : metric_ids(cell)) write_metric_row(html, farm, cell, id);
  write_words_row(html, cell, "Seen at", viewing_text);
}

void write_plan(Html& html, const CheckedCell& cell) {
  const EnginePicture* ours = cell.find_image(cell.hub);
  const Tag section(html, "section", {{"aria-labelledby", "plan"}});
  html.element("h2", {{"id", "plan"}}, "The plan");
  if (!ours || !ours->render || ours->render->plan.effects.empty())
    return write_absence(html, "The record of our picture has no plan.");
  html.element("p", "Which effects this scene calls for; our renderer simulates nothing else.");
  const Tag wrap(html, "div", {{"class", "table-wrap"}, {"tabindex", "0"}});
  const Tag table(html, "table");
  write_columns(html, {"Effect", "State", "Why"});
  const Tag tbody(html, "tbody");
  for (const records::Effect& effect : ours->render->plan.effects) {
    const Tag row(html, "tr");
    html.element("th", {{"scope", "row"}}, effect.name);
    html.element("td", {{"class", effect.on ? "on" : "off"}}, effect.on ? "● on" : "○ off");
    html.element("td", effect.reason);
  }
}

}  // namespace lobelia::gallery
