// The report for a person in front of a terminal.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error_time_chart.hpp"
#include "cost/pareto.hpp"
#include "cost/report.hpp"

namespace lobelia::cost {
namespace {

std::string table_text(const Table& table, bool all) {
  std::size_t width = 4;
  for (const Way& way : table.ways) width = std::max(width, way.name.size());
  std::string text =
      fmt::format("\n{}\n{:<{}}{:>15}{:>8}", table.title, "way", width + 2,
                  table.is_timed() ? "per " + table.per : table.unit, table.is_timed() ? "+-" : "");
  for (const ErrorKind& kind : table.errors) text += fmt::format("{:>14}", kind.id);
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
    for (const double error : way.errors)
      text += std::isnan(error) ? fmt::format("{:>14}", "-") : fmt::format("{:>14.3g}", error);
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
