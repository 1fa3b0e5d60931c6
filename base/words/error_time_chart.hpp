// A chart of error over time: what accuracy costs, with the Pareto front of the fastest variant for each error.
#pragma once

#include <string>
#include <vector>

#include "base/words/svg_chart.hpp"

namespace lobelia {

struct TimedError {
  std::string name;        ///< drawn beside points of the front, where there is room
  std::string label;       ///< tooltip
  double cost = 0;         ///< seconds, or in ErrorTimes::cost_unit
  double cost_error = 0;   ///< half length of its error bar
  double error = 0;        ///< not negative
  double error_error = 0;  ///< half length of its error bar
  bool on_front = false;
  std::string key = {};  ///< for ChartSeries::point_keys
};

struct ErrorTimes {
  std::string id;  ///< unique on the page
  std::string title;
  std::string per;                 ///< what costs: "evaluation"
  std::string cost_unit;           ///< empty: seconds, shown in a unit that fits
  std::string error_label;         ///< says what the error is relative to
  std::vector<TimedError> points;  ///< points that are not finite are left out
};

/// Both axes are logarithmic and end at the data. Points without any error lie at the start, which is then labelled 0.
Chart error_time_chart(const ErrorTimes& times);

/// The cheapest point for each power of ten of an error that is a share: "You may be off by 0.1 %: use pk3.2, 0.11 ns."
/// One sentence for each point, with the smallest of its powers.
std::vector<std::string> answers(const ErrorTimes& times);

/// "3.14 ns", "0.42 ms", "1.70 s": three digits.
std::string short_time_text(double seconds);
/// That of seconds, "s"; of other units three digits and the unit.
std::string quantity_text(double value, const std::string& unit);

}  // namespace lobelia
