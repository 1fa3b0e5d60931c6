#include "studies/cost/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/words/error_time_chart.hpp"
#include "studies/table.hpp"

namespace lobelia::cost {
namespace {

/// "1.8 times", "170 times", "1.3e+04 times", "infinitely many times"
std::string times_text(double more, double less) {
  const double ratio = less != 0   ? more / less
                       : more == 0 ? 1
                                   : std::numeric_limits<double>::infinity();
  if (!std::isfinite(ratio)) return "infinitely many times";
  if (ratio >= 9999.5) return fmt::format("{:.2g} times", ratio);
  return fmt::format("{:.{}f} times", ratio, ratio < 9.95 ? 1 : 0);
}

bool on_front(const Table& table, std::size_t error, const Variant& variant) {
  return std::ranges::count(table.fronts[error].second.variants, variant.name) > 0;
}

/// A variant's own value of an error, if it has one.
const double* value_of(const std::optional<records::Named<double>>& values, const Table& table,
                       std::size_t error) {
  return values ? records::find(*values, table.errors[error].id) : nullptr;
}

/// Both ends, where they are not the same in print.
std::string error_text(const Table& table, const Variant& variant, std::size_t e) {
  const double error = variant.errors[e].second;
  if (std::isnan(error)) return "-";
  const std::string found = fmt::format("{:.3g}", error);
  const double* bound = value_of(variant.errors_at_most, table, e);
  const std::string most = bound ? fmt::format("{:.3g}", *bound) : found;
  return most == found ? found : found + ".." + most;
}

std::string one_table_text(const Table& table, bool all) {
  const bool timed = is_timed(table);
  studies::Table shown{table.title,
                       {{.title = "variant", .width = -6, .margin = 2},
                        {timed ? "per " + table.per : table.unit, 15, "{:.6g}"},
                        {timed ? "+-" : "", 8}},
                       {}};
  for (const records::CostError& error : table.errors)
    shown.columns.push_back({.title = error.id, .width = 14, .margin = 3});
  shown.columns.push_back({.title = "front", .gap = 2});
  std::vector<const Variant*> order;
  for (const Variant& variant : table.variants) order.push_back(&variant);
  std::ranges::stable_sort(order, [](const Variant* a, const Variant* b) {
    return cost_of(*a).median < cost_of(*b).median;
  });
  for (const Variant* variant : order) {
    const records::MeasuredRounds cost = cost_of(*variant);
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
  std::string text;
  for (const auto& [id, front] : table.fronts)
    if (front.answers && !front.answers->empty()) {
      text = fmt::format("\n{}, {}\n", table.title,
                         table.errors[0].id == id ? "in short:" : "by " + id + ":");
      for (const std::string& answer : *front.answers) text += "  " + answer + "\n";
      break;
    }
  shown.fit();
  if (!all) std::erase_if(shown.rows, [](const auto& row) { return row.back().text.empty(); });
  if (!table.fronts.empty())
    for (const std::string& sentence : table.fronts[0].second.in_words)
      if (all || sentence.starts_with("from ")) shown.remarks.push_back(sentence);
  shown.remarks.insert(shown.remarks.end(), table.remarks.begin(), table.remarks.end());
  return text + table_text(shown);
}

ErrorTimes error_times(const Table& table, std::size_t error) {
  const std::string& id = table.errors[error].id;
  ErrorTimes times{
      table.id + "-" + id,         table.title, table.per, is_timed(table) ? "" : table.unit,
      table.errors[error].meaning, {}};
  for (const Variant& variant : table.variants) {
    const records::MeasuredRounds cost = cost_of(variant);
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
  return times;
}

}  // namespace

records::MeasuredRounds cost_of(const Variant& variant) {
  if (variant.seconds) return *variant.seconds;
  const double count = variant.count.value_or(0);
  return {count, 0, count, count, 0};
}

double setting(const Variant& variant, std::string_view name) {
  const std::string* value = records::find(variant.settings, name);
  return value ? std::strtod(value->c_str(), nullptr) : std::numeric_limits<double>::quiet_NaN();
}

int clearly_slower(const Variant& a, const Variant& b) {
  const records::MeasuredRounds of_a = cost_of(a), of_b = cost_of(b);
  const double noise = of_a.spread * of_a.median + of_b.spread * of_b.median;
  const double difference = of_b.median - of_a.median;
  return difference > noise ? 1 : difference < -noise ? -1 : 0;
}

records::CostFront pareto_front(const Table& table, std::size_t error) {
  struct Point {
    const Variant* variant;
    double cost, error;
    const Point* better = nullptr;  ///< of the front
  };
  std::vector<Point> points;
  for (const Variant& variant : table.variants)
    if (!std::isnan(variant.errors[error].second))
      points.push_back({&variant, cost_of(variant).median, variant.errors[error].second});
  std::vector<Point*> order;
  for (Point& point : points) order.push_back(&point);
  std::ranges::stable_sort(order, [](const Point* a, const Point* b) {
    return a->cost != b->cost ? a->cost < b->cost : a->error < b->error;
  });
  std::vector<const Point*> front;
  for (Point* point : order) {
    // The fastest variant that is as accurate: the one to use instead.
    const auto better =
        std::ranges::find_if(front, [&](const Point* f) { return f->error <= point->error; });
    if (better == front.end())
      front.push_back(point);
    else
      point->better = *better;
  }

  records::CostFront record;
  record.chart = table.id + "-" + table.errors[error].id + ".svg";
  const std::string unit = is_timed(table) ? "time" : table.unit;
  for (std::size_t i = 0; i < front.size(); ++i) {
    record.variants.push_back(front[i]->variant->name);
    if (i == 0) continue;
    const Point &from = *front[i - 1], &to = *front[i];
    record.in_words.push_back(
        fmt::format("from {} to {}: {} the {}, {} less error", from.variant->name, to.variant->name,
                    times_text(to.cost, from.cost), unit, times_text(from.error, to.error)));
  }
  for (const Point& point : points) {
    if (!point.better) continue;
    const Point& better = *point.better;
    const bool same = better.error == 0 ? point.error == 0 : point.error / better.error < 1.005;
    record.dominated_by.emplace_back(point.variant->name, better.variant->name);
    record.in_words.push_back(fmt::format("{} takes {} the {} of {} and has {}its error",
                                          point.variant->name, times_text(point.cost, better.cost),
                                          unit, better.variant->name,
                                          same ? "" : times_text(point.error, better.error) + " "));
  }
  return record;
}

void add_fronts(Table& table) {
  for (std::size_t e = 0; e < table.errors.size(); ++e) {
    table.fronts.emplace_back(table.errors[e].id, pareto_front(table, e));
    if (!table.errors[e].meaning.ends_with("of the peak")) continue;
    ErrorTimes times = error_times(table, e);
    for (std::size_t i = 0; i < table.variants.size(); ++i)
      if (const double* most = value_of(table.variants[i].errors_at_most, table, e))
        times.points[i].error = *most;
    table.fronts.back().second.answers = answers(times);
  }
}

std::string cost_csv(const records::Cost& report) {
  studies::Table lines;
  for (const char* column :
       {"table", "level", "way", "settings", "per", "unit", "median", "spread", "least", "most",
        "rounds", "error", "value", "error_spread", "on_front", "at_most"})
    lines.columns.push_back({column});
  const auto if_any = [](const double* value) { return value ? studies::Cell(*value) : ""; };
  for (const Table& table : report.tables)
    for (std::size_t e = 0; e < table.errors.size(); ++e)
      for (const Variant& variant : table.variants) {
        const records::MeasuredRounds cost = cost_of(variant);
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
  return draw_chart_file(error_time_chart(error_times(table, error)));
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
