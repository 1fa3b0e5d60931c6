#include "base/words/error_time_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words/constants.hpp"
#include "base/words/numbers.hpp"

namespace lobelia {
namespace {

struct Unit {
  const char* name;
  double seconds;
};
Unit unit_for(double seconds) {
  if (seconds < 1e-6) return {"ns", 1e-9};
  if (seconds < 1e-3) return {"µs", 1e-6};
  if (seconds < 1) return {"ms", 1e-3};
  return {"s", 1};
}

bool can_be_drawn(const TimedError& point) {
  return point.cost >= kSmallestDrawn && point.cost <= kLargestDrawn && point.error >= 0 &&
         point.error <= kLargestDrawn;
}

/// Somewhat more than all values above 0, and a power of ten among them, so that the axis has a label.
void widen(ChartAxis& axis, const std::vector<double>& values) {
  double least = kInfinity, most = 0;
  for (const double value : values)
    if (value >= kSmallestDrawn) least = std::min(least, value), most = std::max(most, value);
  if (most == 0) least = most = 1;
  axis.logarithmic = true;
  constexpr double kRoom = 1.4;
  axis.from = least / kRoom;
  axis.to = most * kRoom;
  const double above = std::pow(10, std::ceil(std::log10(axis.from)));
  if (above > axis.to) axis.to = above;
}

void add(ChartSeries& series, const TimedError& point, double x, double y, double unit) {
  series.x.push_back(x);
  series.y.push_back(y);
  series.x_error.push_back(point.cost_error / unit);
  series.y_error.push_back(point.error_error);
  series.point_labels.push_back(point.label);
  if (!point.key.empty()) series.point_keys.push_back(point.key);
}

}  // namespace

Chart error_time_chart(const ErrorTimes& times) {
  std::vector<TimedError> points;
  std::ranges::copy_if(times.points, std::back_inserter(points), can_be_drawn);
  std::ranges::stable_sort(points, {}, &TimedError::cost);  // along the front, from the fastest on
  const Unit unit = times.cost_unit.empty() ? unit_for(points.empty() ? 1 : points.front().cost)
                                            : Unit{times.cost_unit.c_str(), 1};
  Chart chart;
  chart.id = times.id;
  chart.title = times.title;
  chart.description =
      fmt::format("{} over {}; {} variants, of which {} are on the Pareto front", times.error_label,
                  times.cost_unit.empty() ? "time" : times.cost_unit, points.size(),
                  std::ranges::count(points, true, &TimedError::on_front));
  chart.height = 460;
  chart.x.label = fmt::format("{} per {}", unit.name, times.per);
  chart.y.label = times.error_label;
  std::vector<double> costs, errors;
  for (const TimedError& point : points) {
    costs.push_back(point.cost / unit.seconds);
    errors.push_back(point.error);
  }
  widen(chart.x, costs);
  widen(chart.y, errors);
  if (std::ranges::count(errors, 0.0) > 0) chart.y.from /= 10, chart.y.starts_at_zero = true;

  ChartSeries front{"Pareto front", {}, {}, 1};
  ChartSeries on{"on the front", {}, {}, 1}, off{"beaten in both", {}, {}, 2};
  on.markers = off.markers = true;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = costs[i], y = std::max(errors[i], chart.y.from);
    add(points[i].on_front ? on : off, points[i], x, y, unit.seconds);
    if (!points[i].on_front) continue;
    on.point_names.push_back(points[i].name);
    // A step: between two points the faster one's error applies.
    if (!front.x.empty()) front.x.push_back(x), front.y.push_back(front.y.back());
    front.x.push_back(x);
    front.y.push_back(y);
  }
  chart.series = {off, front, on};  // the front is drawn over dominated points
  return chart;
}

std::vector<std::string> answers(const ErrorTimes& times) {
  constexpr int kLeastPower = -12;
  std::vector<std::string> sentences;
  const TimedError* last = nullptr;
  for (int power = -1; power >= kLeastPower; --power) {
    const double most = std::pow(10, power);
    const TimedError* cheapest = nullptr;
    for (const TimedError& point : times.points)
      if (can_be_drawn(point) && point.error <= most &&
          (!cheapest ||
           std::pair(point.cost, point.error) < std::pair(cheapest->cost, cheapest->error)))
        cheapest = &point;
    if (!cheapest) break;
    if (cheapest == last) sentences.pop_back();
    last = cheapest;
    const std::string off = power >= -6 ? percent_text(most) : power_of_ten_text(power);
    sentences.push_back(fmt::format(
        "You may be off by {}: use {}, {}.", off, cheapest->name,
        quantity_text(cheapest->cost, times.cost_unit.empty() ? "s" : times.cost_unit)));
  }
  return sentences;
}

std::string short_time_text(double seconds) {
  const auto scaled = [](double value, const char* unit) {
    return fmt::format("{:.{}f} {}", value, value < 9.995 ? 2 : value < 99.95 ? 1 : 0, unit);
  };
  if (seconds == 0) return "0 s";
  if (seconds < 1e-6) return scaled(seconds * 1e9, "ns");
  if (seconds < 1e-3) return scaled(seconds * 1e6, "µs");
  if (seconds < 1) return scaled(seconds * 1e3, "ms");
  return scaled(seconds, "s");
}

std::string quantity_text(double value, const std::string& unit) {
  return unit == "s" ? short_time_text(value) : number_text(value, 3) + " " + unit;
}

}  // namespace lobelia
