// Error over time as a drawing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/files.hpp"
#include "core/svg_chart.hpp"
#include "cost/pareto.hpp"
#include "cost/report.hpp"

namespace lobelia::cost {
namespace {

struct Unit {
  std::string name;
  double size;
};
Unit unit_for(const Table& table, double seconds) {
  if (!table.is_timed()) return {table.unit, 1};
  if (seconds < 1e-6) return {"ns", 1e-9};
  if (seconds < 1e-3) return {"us", 1e-6};
  if (seconds < 1) return {"ms", 1e-3};
  return {"s", 1};
}

/// A whole number of decades around all values above 0.
void widen(ChartAxis& axis, const std::vector<double>& values) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double value : values)
    if (value > 0 && std::isfinite(value))
      least = std::min(least, value), most = std::max(most, value);
  if (most == 0) least = most = 1;
  axis.logarithmic = true;
  axis.from = std::pow(10, std::floor(std::log10(least * 0.9)));
  axis.to = std::pow(10, std::ceil(std::log10(most * 1.1)));
}

}  // namespace

std::string cost_chart(const Table& table, std::size_t error) {
  double least = std::numeric_limits<double>::infinity();
  for (const Way& way : table.ways) least = std::min(least, way.time.median);
  const Unit unit = unit_for(table, std::isfinite(least) ? least : 1);
  const Front front = pareto_front(table, error);
  ChartSeries line{"the Pareto front", {}, {}, 1}, on{"on it", {}, {}, 1},
      off{"dominated", {}, {}, 2};
  on.markers = off.markers = true;
  Chart chart;
  chart.id = table.id + "-" + table.errors[error].id;
  chart.title = table.title;
  chart.description =
      fmt::format("{} over time; {} ways, of which {} are on the front",
                  table.errors[error].meaning, table.ways.size(), front.ways.size());
  chart.height = 460;
  chart.x.label = fmt::format("{} per {}", unit.name, table.per);
  chart.y.label = table.errors[error].meaning;
  const auto time = [&](const Way& way) { return way.time.median / unit.size; };
  std::vector<double> times, errors;
  for (const Way& way : table.ways) times.push_back(time(way)), errors.push_back(way.errors[error]);
  widen(chart.x, times);
  widen(chart.y, errors);
  // No error at all has no place on a logarithm: it lies on the axis.
  const auto height = [&](const Way& way) { return std::max(way.errors[error], chart.y.from); };

  const auto add = [&](ChartSeries& series, const Way& way) {
    series.x.push_back(time(way));
    series.y.push_back(height(way));
    series.x_error.push_back(way.time.spread * time(way));
    series.y_error.push_back(way.error_spreads.empty() ? 0 : way.error_spreads[error]);
    series.point_labels.push_back(fmt::format("{}: {}, {} {:.3g}", way.name,
                                              cost_value_text(table, way.time.median),
                                              table.errors[error].id, way.errors[error]));
  };
  for (std::size_t i = 0; i < table.ways.size(); ++i)
    if (front.dominated_by[i] != kNone) add(off, table.ways[i]);
  for (const std::size_t i : front.ways) {
    const Way& way = table.ways[i];
    // A step: between two ways there is only the faster one's error.
    if (!line.x.empty()) line.x.push_back(time(way)), line.y.push_back(line.y.back());
    line.x.push_back(time(way));
    line.y.push_back(height(way));
    add(on, way);
    on.point_names.push_back(way.name);
  }
  chart.series = {off, line, on};  // the front over what it dominates
  return draw_chart_file(chart);
}

void write_cost(const Report& report, const std::filesystem::path& directory) {
  make_directories(directory);
  for (const Table& table : report.tables)
    for (std::size_t e = 0; e < table.errors.size(); ++e)
      write_file(directory / (table.id + "-" + table.errors[e].id + ".svg"), cost_chart(table, e));
  write_file(directory / "cost.csv", cost_csv(report));
  write_record(directory / "cost.json", cost_record(report));
}

}  // namespace lobelia::cost
