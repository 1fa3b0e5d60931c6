// The report for a person in front of a terminal.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error_time_chart.hpp"
#include "cost/pareto.hpp"
#include "cost/report.hpp"

namespace lobelia::cost {
namespace {

/// Both ends, where they are not the same in print; and the standard error of what was drawn from a count, where it is
/// no smaller than the last digit.
std::string error_text(const Table& table, const Way& way, std::size_t e) {
  if (std::isnan(way.errors[e])) return "-";
  const std::string found = fmt::format("{:.3g}", way.errors[e]);
  const double bound = e < way.errors_at_most.size() ? way.errors_at_most[e] : NAN;
  const std::string most = std::isnan(bound) ? found : fmt::format("{:.3g}", bound);
  if (most != found) return found + ".." + most;
  const double spread = !table.is_timed() && !way.error_spreads.empty() ? way.error_spreads[e] : 0;
  return spread > 0.001 * way.errors[e] ? fmt::format("{}+-{:.1g}", found, spread) : found;
}

std::string table_text(const Table& table, bool all) {
  std::size_t width = 4;
  for (const Way& way : table.ways) width = std::max(width, way.name.size());
  std::string text =
      fmt::format("\n{}\n{:<{}}{:>15}{:>8}", table.title, "way", width + 2,
                  table.is_timed() ? "per " + table.per : table.unit, table.is_timed() ? "+-" : "");
  std::vector<std::size_t> columns;
  for (std::size_t e = 0; e < table.errors.size(); ++e) {
    columns.push_back(14);
    for (const Way& way : table.ways)
      columns[e] = std::max(columns[e], error_text(table, way, e).size() + 3);
    text += fmt::format("{:>{}}", table.errors[e].id, columns[e]);
  }
  text += "  front\n";
  std::vector<std::size_t> order(table.ways.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return table.ways[i].time.median < table.ways[j].time.median;
  });
  std::vector<Front> fronts;
  for (std::size_t e = 0; e < table.errors.size(); ++e) fronts.push_back(pareto_front(table, e));
  for (const std::size_t i : order) {
    const Way& way = table.ways[i];
    std::string on;
    for (std::size_t e = 0; e < fronts.size(); ++e)
      if (std::find(fronts[e].ways.begin(), fronts[e].ways.end(), i) != fronts[e].ways.end())
        on += (on.empty() ? "" : " ") + table.errors[e].id;
    if (on.empty() && !all) continue;
    text += table.is_timed()
                ? fmt::format("{:<{}}{:>15}{:>7.1f}%", way.name, width + 2,
                              short_time_text(way.time.median), 100 * way.time.spread)
                : fmt::format("{:<{}}{:>15.6g}{:>8}", way.name, width + 2, way.time.median, "");
    for (std::size_t e = 0; e < columns.size(); ++e)
      text += fmt::format("{:>{}}", error_text(table, way, e), columns[e]);
    text += "  " + on + "\n";
  }
  if (!table.errors.empty())
    for (const std::string& sentence : front_sentences(table, 0))
      if (all || sentence.starts_with("from ")) text += "  " + sentence + "\n";
  for (const std::string& remark : table.remarks) text += "  " + remark + "\n";
  return text;
}

}  // namespace

std::string cost_value_text(const Table& table, double value) {
  return table.is_timed() ? short_time_text(value) : fmt::format("{:.6g} {}", value, table.unit);
}

std::string cost_text(const Report& report, bool all) {
  std::string text;
  for (const Table& table : report.tables) text += table_text(table, all);
  return text;
}

}  // namespace lobelia::cost
