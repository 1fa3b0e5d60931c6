#include "core/svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/html.hpp"
#include "core/numbers.hpp"

namespace lobelia {

namespace embedded {
extern const std::string_view chart_style;
}

namespace {

double round_step(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double share = rough / power;
  return power * (share <= 1 ? 1 : share <= 2 ? 2 : share <= 5 ? 5 : 10);
}

constexpr double kLeft = 78, kRight = 12, kTop = 34, kBottom = 50;
constexpr double kTitle = 36, kMargin = 16;  // above and on the right, in a file of its own
constexpr double kCharacter = 7.2;           // typical width at the font size of the styles
constexpr double kNameCharacter = 6.3;       // the same in the name of a point

struct LineStyle {
  const char *name, *dashes, *width;
};

const LineStyle& line_style(const ChartSeries& series) {
  static constexpr LineStyle kStyles[] = {
      {"series series-0", "none", "7"},       {"series series-1", "none", "1.8"},
      {"series series-2", "9 5", "2.2"},      {"series series-3", "2 4", "2.6"},
      {"series series-4", "12 4 2 4", "2.2"}, {"series series-5", "5 3", "2.2"}};
  return kStyles[std::clamp(series.style, 0, int(std::size(kStyles)) - 1)];
}

std::string number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  return text == "-0.00" ? "0.00" : text;
}

int text_length(std::string_view text) {
  return int(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

class Drawing {
 public:
  explicit Drawing(const Chart& chart) : chart_(chart) {}

  std::string draw() {
    {
      const Tag svg(html_, "svg",
                    {{"class", "chart"},
                     {"viewBox", fmt::format("0 0 {} {}", chart_.width, chart_.height)},
                     {"role", "img"},
                     {"aria-labelledby", chart_.id + "-title " + chart_.id + "-desc"}});
      draw_contents();
    }
    return html_.str();
  }

  std::string draw_file() {
    {
      const double width = chart_.width + kMargin, height = chart_.height + kTitle;
      const Tag svg(html_, "svg",
                    {{"xmlns", "http://www.w3.org/2000/svg"},
                     {"class", "chart"},
                     {"width", number(width)},
                     {"height", number(height)},
                     {"viewBox", fmt::format("0 {} {} {}", -kTitle, width, height)},
                     {"role", "img"},
                     {"aria-labelledby", chart_.id + "-title " + chart_.id + "-desc"}});
      html_.element("style", embedded::chart_style);
      html_.empty("rect", {{"class", "ground"},
                           {"y", number(-kTitle)},
                           {"width", number(width)},
                           {"height", number(height)}});
      text("chart-title", kLeft, -10, "start", chart_.title);
      draw_contents();
    }
    return html_.str();
  }

 private:
  void draw_contents() {
    html_.element("title", {{"id", chart_.id + "-title"}}, chart_.title);
    html_.element("desc", {{"id", chart_.id + "-desc"}}, chart_.description);
    draw_clip();
    for (std::size_t i = 0; i < chart_.bands.size(); ++i) draw_band(chart_.bands[i], i);
    draw_x_axis();
    draw_y_axis();
    for (const ChartSeries& series : chart_.series) draw_series(series);
    draw_legend();
  }

  /// The axis's own ticks, otherwise about `count` round numbers.
  static std::vector<Tick> ticks_of(const ChartAxis& axis, int count) {
    if (axis.ticks.empty())
      return axis.logarithmic ? log_ticks(axis.from, axis.to)
                              : linear_ticks(axis.from, axis.to, count);
    std::vector<Tick> ticks;
    for (const double value : axis.ticks) ticks.push_back({value, number_text(value)});
    return ticks;
  }

  static double share(const ChartAxis& axis, double value) {
    if (axis.logarithmic) return std::log(value / axis.from) / std::log(axis.to / axis.from);
    return (value - axis.from) / (axis.to - axis.from);
  }
  double right() const { return chart_.width - kRight; }
  double bottom() const { return chart_.height - kBottom; }
  double at_x(double value) const { return kLeft + share(chart_.x, value) * (right() - kLeft); }
  double at_y(double value) const { return bottom() - share(chart_.y, value) * (bottom() - kTop); }

  void line(const char* name, double x1, double y1, double x2, double y2) {
    html_.empty("line", {{"class", name},
                         {"x1", number(x1)},
                         {"y1", number(y1)},
                         {"x2", number(x2)},
                         {"y2", number(y2)}});
  }
  void text(const char* name, double x, double y, const char* anchor, std::string_view words) {
    html_.element("text",
                  {{"class", name}, {"x", number(x)}, {"y", number(y)}, {"text-anchor", anchor}},
                  words);
  }

  void draw_clip() {
    const Tag clip(html_, "clipPath", {{"id", chart_.id + "-clip"}});
    html_.empty("rect", {{"x", number(kLeft)},
                         {"y", number(kTop - 4)},
                         {"width", number(right() - kLeft)},
                         {"height", number(bottom() - kTop + 8)}});
  }

  void draw_band(const ChartBand& band, std::size_t index) {
    const double from = std::clamp(band.from, chart_.x.from, chart_.x.to);
    const double to = std::clamp(band.to, chart_.x.from, chart_.x.to);
    if (!(to > from)) return;
    const double x1 = at_x(from), x2 = at_x(to);
    html_.empty("rect", {{"class", fmt::format("band band-{}", index % 2)},
                         {"x", number(x1)},
                         {"y", number(kTop)},
                         {"width", number(x2 - x1)},
                         {"height", number(bottom() - kTop)}});
    if (band.to <= chart_.x.to) line("band-edge", x2, kTop, x2, bottom());
    if (x2 - x1 > kCharacter * text_length(band.label)) {
      text("band-label", (x1 + x2) / 2, kTop + 15, "middle", band.label);
    }
  }

  void draw_x_axis() {
    for (const Tick& tick : ticks_of(chart_.x, 10)) {
      const double x = at_x(tick.value);
      line("tick", x, bottom(), x, bottom() + 5);
      text("tick-label", x, bottom() + 19, "middle", tick.label);
    }
    line("axis", kLeft, bottom(), right(), bottom());
    text("axis-label", (kLeft + right()) / 2, chart_.height - 8.0, "middle", chart_.x.label);
  }

  void draw_y_axis() {
    for (const Tick& tick : ticks_of(chart_.y, 5)) {
      const double at = at_y(tick.value);
      if (tick.label.empty()) {
        line("tick", kLeft - 3, at, kLeft, at);
        continue;
      }
      line("grid-line", kLeft, at, right(), at);
      text("tick-label", kLeft - 8, at + 4, "end", tick.label);
    }
    line("axis", kLeft, kTop, kLeft, bottom());
    const double middle = (kTop + bottom()) / 2;
    html_.element("text",
                  {{"class", "axis-label"},
                   {"transform", fmt::format("translate(16 {}) rotate(-90)", number(middle))},
                   {"text-anchor", "middle"}},
                  chart_.y.label);
  }

  std::string path_of(const ChartSeries& series) const {
    std::string path;
    bool drawing = false;
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      const double x = series.x[i], y = series.y[i];
      if (!std::isfinite(x) || !std::isfinite(y) || (chart_.y.logarithmic && y <= 0)) {
        drawing = false;
        continue;
      }
      // Points far outside the frame are moved nearer, which keeps the numbers short.
      const double py = std::clamp(at_y(y), -10.0 * chart_.height, 10.0 * chart_.height);
      const double px = std::clamp(at_x(x), -10.0 * chart_.width, 10.0 * chart_.width);
      path += fmt::format("{}{} {}", drawing ? "L" : "M", number(px), number(py));
      drawing = true;
    }
    return path;
  }

  /// A circle, diamond or square, so that styles differ without colour.
  void draw_marker(const ChartSeries& series, double x, double y) {
    constexpr double kRadius = 4.5;
    const std::string name = fmt::format("marker marker-{}", series.style);
    if (series.style % 3 == 1) {
      html_.empty("circle",
                  {{"class", name}, {"cx", number(x)}, {"cy", number(y)}, {"r", number(kRadius)}});
      return;
    }
    html_.empty("rect",
                {{"class", name},
                 {"x", number(x - kRadius)},
                 {"y", number(y - kRadius)},
                 {"width", number(2 * kRadius)},
                 {"height", number(2 * kRadius)},
                 {"transform", fmt::format("rotate({} {} {})", series.style % 3 == 2 ? 45 : 0,
                                           number(x), number(y))}});
  }

  void draw_markers(const ChartSeries& series) {
    const auto value = [](const std::vector<double>& values, std::size_t i) {
      return i < values.size() && std::isfinite(values[i]) ? values[i] : 0;
    };
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      const double x = series.x[i], y = series.y[i];
      if (!is_shown(x, y)) continue;
      Attributes attributes{{"class", "point"}};
      if (i < series.point_keys.size()) attributes.push_back({"data-key", series.point_keys[i]});
      const Tag group(html_, "g", attributes);
      if (i < series.point_labels.size()) html_.element("title", series.point_labels[i]);
      const std::string name = fmt::format("error-bar marker-{}", series.style);
      if (const double half = value(series.x_error, i); half > 0)
        line(name.c_str(), at_x(std::max(x - half, chart_.x.from)), at_y(y), at_x(x + half),
             at_y(y));
      if (const double half = value(series.y_error, i); half > 0)
        line(name.c_str(), at_x(x), at_y(std::max(y - half, chart_.y.from)), at_x(x),
             at_y(y + half));
      draw_marker(series, at_x(x), at_y(y));
      if (i < series.point_names.size()) draw_name(series.point_names[i], at_x(x), at_y(y));
    }
  }

  void draw_name(const std::string& name, double x, double y) {
    constexpr double kAway = 8, kDown = 14, kLine = 13;
    const double width = kNameCharacter * text_length(name), at = y + kDown;
    const bool left = x - kAway - width > kLeft;
    const double from = left ? x - kAway - width : x + kAway;
    const bool free = std::ranges::none_of(names_, [&](const Name& other) {
      return from < other.to && other.from < from + width && std::abs(at - other.y) < kLine;
    });
    if (!free || at >= bottom()) return;
    names_.push_back({from, from + width, at});
    text("point-name", left ? x - kAway : from, at, left ? "end" : "start", name);
  }

  bool is_shown(double x, double y) const {
    const auto within = [](const ChartAxis& axis, double value) {
      return std::isfinite(value) && value >= axis.from && value <= axis.to;
    };
    return within(chart_.x, x) && within(chart_.y, y);
  }

  void draw_series(const ChartSeries& series) {
    if (series.markers) return draw_markers(series);
    const std::string path = path_of(series);
    if (path.empty()) return;
    const LineStyle& style = line_style(series);
    const Tag shape(html_, "path",
                    {{"class", style.name},
                     {"d", path},
                     {"fill", "none"},
                     {"clip-path", "url(#" + chart_.id + "-clip)"},
                     {"stroke-dasharray", style.dashes},
                     {"stroke-width", style.width}});
    html_.element("title", series.label);
  }

  void draw_legend() {
    double x = kLeft;
    for (const ChartSeries& series : chart_.series) {
      const LineStyle& style = line_style(series);
      if (series.markers)
        draw_marker(series, x + 18, 14);
      else
        html_.empty("line", {{"class", style.name},
                             {"x1", number(x)},
                             {"y1", "14"},
                             {"x2", number(x + 36)},
                             {"y2", "14"},
                             {"stroke-dasharray", style.dashes},
                             {"stroke-width", style.width}});
      text("legend", x + 44, 18, "start", series.label);
      x += 44 + kCharacter * text_length(series.label) + 28;
    }
  }

  struct Name {
    double from, to, y;
  };

  const Chart& chart_;
  Html html_;
  std::vector<Name> names_;  ///< of points, drawn so far
};

}  // namespace

std::vector<Tick> linear_ticks(double from, double to, int count) {
  std::vector<Tick> ticks;
  if (!(to > from) || count < 1) return ticks;
  const double step = round_step((to - from) / count);
  // Multiples of a whole number, so that 0.3 is not 0.1 + 0.2.
  const double first = std::ceil(from / step - 1e-9), last = std::floor(to / step + 1e-9);
  for (double i = first; i <= last && ticks.size() < 100; ++i) {
    const double value = i == 0 ? 0 : i * step;
    ticks.push_back({value, number_text(value)});
  }
  return ticks;
}

std::vector<Tick> log_ticks(double from, double to) {
  std::vector<Tick> ticks;
  if (!(from > 0) || !(to > from)) return ticks;
  const int first = static_cast<int>(std::floor(std::log10(from) - 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(to) + 1e-9));
  const int every = std::max(1, (last - first + 7) / 8);
  for (int power = first; power <= last; ++power) {
    const double base = std::pow(10.0, power);
    for (int digit = 1; digit <= (every == 1 ? 9 : 1); ++digit) {
      const double value = digit * base;
      if (value < from * (1 - 1e-9) || value > to * (1 + 1e-9)) continue;
      const bool labelled = digit == 1 && power % every == 0;
      ticks.push_back({value, labelled ? power_of_ten_text(power) : ""});
    }
  }
  return ticks;
}

double round_up(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  const double step = round_step(value / 5);
  return step * std::ceil(value / step - 1e-9);
}

std::string draw_chart(const Chart& chart) { return Drawing(chart).draw(); }
std::string draw_chart_file(const Chart& chart) { return Drawing(chart).draw_file(); }

}  // namespace lobelia
