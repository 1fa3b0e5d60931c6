// The main metric over the runs, as a chart.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words/svg_chart.hpp"
#include "gallery/cells/cell_changes.hpp"

namespace lobelia::gallery {
namespace {

constexpr double kLogarithmicFrom = 30;  // largest by smallest value

/// An error without its sign. False for a value that cannot be drawn.
bool add_point(ChartSeries& series, std::size_t run, const std::optional<double>& value) {
  if (!value || !(std::abs(*value) <= kLargestDrawn)) return false;
  series.x.push_back(double(run + 1));
  series.y.push_back(std::abs(*value));
  return true;
}

/// Around all values: over decades, from 0 on, or for a likeness from the least on.
void fit_axis(ChartAxis& axis, const std::vector<ChartSeries>& series, bool is_likeness) {
  std::vector<double> all;
  for (const ChartSeries& one : series) all.insert(all.end(), one.y.begin(), one.y.end());
  const auto [low, high] = std::ranges::minmax(all);
  axis.logarithmic = low > kSmallestDrawn && high > kLogarithmicFrom * low;
  if (axis.logarithmic) {
    axis.from = std::pow(10, std::floor(std::log10(low)));
    axis.to = std::pow(10, std::ceil(std::log10(high)));
  } else {
    axis.from = is_likeness && low < high ? low : 0;
    axis.to = is_likeness && low < high ? high : round_up(1.05 * high);
  }
}

}  // namespace

void write_timeline(Html& html, const ShownFarm& farm, const Timeline& line) {
  const MetricInfo metric = farm.metrics.info(line.metric);
  ChartSeries limit{"limit", {}, {}, 2}, measured{"measured", {}, {}, 1, true};
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const TimePoint& point = line.points[i];
    add_point(limit, i, point.limit);
    if (!add_point(measured, i, point.value)) continue;
    measured.point_names.push_back(point.date);
    measured.point_labels.push_back(fmt::format("{}, {}: {}", point.date, point.name,
                                                farm.metrics.text(line.metric, *point.value)));
  }
  if (measured.x.empty()) return;
  Chart chart{.id = "timeline-" + line.engine,
              .title = metric.title + " over the runs",
              .description = fmt::format("{}: {}.", farm.engine_title(line.engine),
                                         fmt::join(measured.point_labels, ". ")),
              .width = 760,
              .height = 220,
              .x = {"run, the latest last", 0.5, double(line.points.size()) + 0.5},
              .y = {metric.title},
              .series = {std::move(limit), std::move(measured)}};
  fit_axis(chart.y, chart.series, metric.more_is_better);
  const Tag figure(html, "figure", {{"class", "chart-figure timeline"}, {"tabindex", "0"}});
  html.element("figcaption", chart.title);
  html.raw(draw_chart(chart));
}

}  // namespace lobelia::gallery
