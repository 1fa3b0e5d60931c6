// A line chart as SVG, inline or a file of its own. Inline, colours come from the page, so that it
// follows the page into the dark; dash patterns are in the drawing itself, so that lines can be told
// apart without colour.
#pragma once

#include <string>
#include <vector>

namespace lobelia {

/// Values whose size is out of this range are not drawn: an axis has no room for their digits.
inline constexpr double kSmallestDrawn = 1e-250, kLargestDrawn = 1e250;

struct ChartAxis {
  std::string label;  ///< with its unit
  double from = 0, to = 1;
  bool logarithmic = false;        ///< then from > 0
  std::vector<double> ticks = {};  ///< labelled values; empty: round numbers
};

struct ChartBand {
  double from = 0, to = 0;  ///< on the x axis
  std::string label;
};

struct ChartSeries {
  std::string label;
  std::vector<double> x, y;  ///< a value that is not finite, or not above 0 on a log axis, is a gap
  int style = 0;             ///< 0 is a broad pale line to lie under the others; 1 to 5 are dashes
  bool markers = false;      ///< points by themselves, of the style's colour and a shape of its own
  /// Of markers: half lengths of error bars, and what a reader is told of a point. Empty, or one a point.
  std::vector<double> x_error = {}, y_error = {};
  std::vector<std::string> point_labels = {};
  /// Drawn below and left of a point, where nothing dominates it; of names that would overlap the first.
  std::vector<std::string> point_names = {};
  std::vector<std::string> point_keys = {};  ///< "data-key", by which a script knows a point
};

struct Chart {
  std::string id;     ///< unique on the page
  std::string title;  ///< read by screen readers; drawn only where the chart stands alone
  std::string description;
  int width = 1200, height = 360;
  ChartAxis x, y;
  std::vector<ChartBand> bands;
  std::vector<ChartSeries> series;
};

std::string draw_chart(const Chart& chart);
/// The same as an SVG file of its own: with its title, its colours (light, and dark for a reader who
/// prefers that) and a ground to stand on.
std::string draw_chart_file(const Chart& chart);

}  // namespace lobelia
