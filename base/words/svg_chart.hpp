// A line chart as SVG, inline in a page or as a file of its own. Inline its colours come from the page, which may be dark;
// its dash patterns are its own, so that lines differ without colour.
#pragma once

#include <string>
#include <vector>

namespace lobelia {

struct Tick {
  double value = 0;
  std::string label;  ///< empty: a minor tick
};

/// About `count` multiples of 1, 2 or 5 times a power of ten inside [from, to].
std::vector<Tick> linear_ticks(double from, double to, int count);
/// Powers of ten inside [from, to] with labels "10⁻³". Few decades get minor ticks at 2 to 9 times them; of many decades
/// every second or third has a label.
std::vector<Tick> log_ticks(double from, double to);
/// A round number at or above `value`, for the end of an axis; 1 if value is not positive.
double round_up(double value);

/// Larger and smaller values are not drawn: an axis has no room for their digits.
inline constexpr double kSmallestDrawn = 1e-250, kLargestDrawn = 1e250;

struct ChartAxis {
  std::string label;  ///< with its unit
  double from = 0, to = 1;
  bool logarithmic = false;        ///< then from > 0
  std::vector<double> ticks = {};  ///< values with labels; empty: round numbers
  bool starts_at_zero = false;     ///< of a logarithmic axis: its start is labelled 0
};

struct ChartBand {
  double from = 0, to = 0;  ///< on the x axis
  std::string label;
};

struct ChartSeries {
  std::string label;
  std::vector<double> x, y;  ///< a value that is not finite, or not above 0 on a log axis, is a gap
  int style = 0;             ///< 0: a broad pale line beneath the others; 1 to 5: dashes
  bool markers = false;      ///< points instead of a line, in the style's colour and shape
  /// For markers: half lengths of error bars, and tooltips. Empty, or one for each point.
  std::vector<double> x_error = {}, y_error = {};
  std::vector<std::string> point_labels = {};
  /// Drawn beside each point, or farther off with a line to it, where there is room; those of later series first.
  std::vector<std::string> point_names = {};
  std::vector<std::string> point_keys = {};  ///< "data-key", the point's key for scripts
};

struct Chart {
  std::string id;     ///< unique on the page
  std::string title;  ///< for screen readers; drawn only in a file of its own
  std::string description;
  int width = 1200, height = 360;
  double marker_radius = 4.5;
  ChartAxis x = {}, y = {};
  std::vector<ChartBand> bands = {};
  std::vector<ChartSeries> series = {};
};

std::string draw_chart(const Chart& chart);
/// The same as a file of its own: with title, background, and colours for light and dark mode.
std::string draw_chart_file(const Chart& chart);

}  // namespace lobelia
