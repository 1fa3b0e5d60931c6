#include "studies/cost/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error_time_chart.hpp"
#include "core/files.hpp"
#include "records/record.hpp"
#include "studies/table.hpp"

namespace lobelia::cost {
namespace {

bool on_front(const Table& table, std::size_t error, const Variant& variant) {
  return std::ranges::count(table.fronts[error].second.ways, variant.name) > 0;
}

/// A variant's own value of an error, if it has one.
const double* value_of(const std::optional<records::Named<double>>& values, const Table& table,
                       std::size_t error) {
  return values ? records::find(*values, table.errors[error].id) : nullptr;
}

/// Both ends, where they are not the same in print; and the standard error of what was drawn from a count, where it is
/// no smaller than the last digit.
std::string error_text(const Table& table, const Variant& variant, std::size_t e) {
  const double error = variant.errors[e].second;
  if (std::isnan(error)) return "-";
  const std::string found = fmt::format("{:.3g}", error);
  const double* bound = value_of(variant.errors_at_most, table, e);
  const std::string most = bound ? fmt::format("{:.3g}", *bound) : found;
  if (most != found) return found + ".." + most;
  const double* spread = value_of(variant.error_spreads, table, e);
  return !is_timed(table) && spread && *spread > 0.001 * error
             ? fmt::format("{}+-{:.1g}", found, *spread)
             : found;
}

std::string one_table_text(const Table& table, bool all) {
  const bool timed = is_timed(table);
  studies::Table shown{table.title,
                       {{.title = "way", .width = -6, .margin = 2},
                        {timed ? "per " + table.per : table.unit, 15, "{:.6g}"},
                        {timed ? "+-" : "", 8}},
                       {}};
  for (const records::CostError& error : table.errors)
    shown.columns.push_back({.title = error.id, .width = 14, .margin = 3});
  shown.columns.push_back({.title = "front", .gap = 2});
  std::vector<const Variant*> order;
  for (const Variant& variant : table.ways) order.push_back(&variant);
  std::ranges::stable_sort(order, [](const Variant* a, const Variant* b) {
    return cost_of(*a).median < cost_of(*b).median;
  });
  for (const Variant* variant : order) {
    const records::CostSeconds cost = cost_of(*variant);
    auto& row = shown.rows.emplace_back();
    row = {variant->name, cost.median, ""};
    if (timed) row[1] = short_time_text(cost.median);
    if (timed) row[2] = fmt::format("{:.1f}%", 100 * cost.spread);
    std::string on;
    for (std::size_t e = 0; e < table.errors.size(); ++e) {
      row.push_back(error_text(table, *variant, e));
      if (on_front(table, e, *variant)) on += (on.empty() ? "" : " ") + table.errors[e].id;
    }
    row.push_back(on);
  }
  shown.fit();
  if (!all) std::erase_if(shown.rows, [](const auto& row) { return row.back().text.empty(); });
  if (!table.fronts.empty())
    for (const std::string& sentence : table.fronts[0].second.in_words)
      if (all || sentence.starts_with("from ")) shown.remarks.push_back(sentence);
  shown.remarks.insert(shown.remarks.end(), table.remarks.begin(), table.remarks.end());
  return table_text(shown);
}

}  // namespace

std::string cost_csv(const records::Cost& report) {
  studies::Table lines;
  for (const char* column :
       {"table", "level", "way", "settings", "per", "unit", "median", "spread", "least", "most",
        "rounds", "error", "value", "error_spread", "on_front", "at_most"})
    lines.columns.push_back({column});
  const auto if_any = [](const double* value) { return value ? studies::Cell(*value) : ""; };
  for (const Table& table : report.tables)
    for (std::size_t e = 0; e < table.errors.size(); ++e)
      for (const Variant& variant : table.ways) {
        const records::CostSeconds cost = cost_of(variant);
        std::string settings;
        for (const auto& [key, value] : variant.settings)
          settings += fmt::format("{}{}={}", settings.empty() ? "" : " ", key, value);
        lines.rows.push_back({table.id, table.level, variant.name, settings, table.per, table.unit,
                              cost.median, cost.spread, cost.least, cost.most, cost.rounds,
                              table.errors[e].id, variant.errors[e].second,
                              if_any(value_of(variant.error_spreads, table, e)),
                              on_front(table, e, variant) ? "yes" : "no",
                              if_any(value_of(variant.errors_at_most, table, e))});
      }
  return table_csv(lines, "\r\n");
}

std::string cost_text(const records::Cost& report, bool all) {
  std::string text;
  for (const Table& table : report.tables) text += one_table_text(table, all);
  return text;
}

std::string cost_chart(const Table& table, std::size_t error) {
  const std::string& id = table.errors[error].id;
  ErrorTimes times{
      table.id + "-" + id,         table.title, table.per, is_timed(table) ? "" : table.unit,
      table.errors[error].meaning, {}};
  for (const Variant& variant : table.ways) {
    const records::CostSeconds cost = cost_of(variant);
    const double* spread = value_of(variant.error_spreads, table, error);
    const double value = variant.errors[error].second;
    times.points.push_back(
        {variant.name,
         fmt::format("{}: {}, {} {:.3g}", variant.name,
                     is_timed(table) ? short_time_text(cost.median)
                                     : fmt::format("{:.6g} {}", cost.median, table.unit),
                     id, value),
         cost.median, cost.spread * cost.median, value, spread ? *spread : 0,
         on_front(table, error, variant)});
  }
  return draw_chart_file(error_time_chart(times));
}

void write_cost(const records::Cost& report, const std::filesystem::path& directory) {
  make_directories(directory);
  for (const Table& table : report.tables)
    for (std::size_t e = 0; e < table.errors.size(); ++e)
      write_file(directory / table.fronts[e].second.chart, cost_chart(table, e));
  write_file(directory / "cost.csv", cost_csv(report));
  records::write_record(directory / "cost.json", report);
}

}  // namespace lobelia::cost
