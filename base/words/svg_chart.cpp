#include "base/words/svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words/constants.hpp"
#include "base/words/html.hpp"
#include "base/words/numbers.hpp"

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

constexpr double kLeft = 78, kRight = 24, kTop = 34, kBottom = 50;
constexpr double kLine = 17;                 // of the legend, and of words along an axis
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
  explicit Drawing(const Chart& chart) : chart_(chart) {
    // Words along an axis that are longer than it go on in further lines.
    const double legend = legend_places().back().y;
    top_ = kTop + legend;
    y_label_ = wrapped(chart.y.label, chart.height - kBottom - top_);
    left_ = kLeft + kLine * double(y_label_.size() - 1);
    x_label_ = wrapped(chart.x.label, chart.width - left_ - kRight);
    bottom_ = chart.height - kBottom - kLine * double(x_label_.size() - 1);
  }

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
      text("chart-title", left_, -10, "start", chart_.title);
      draw_contents();
    }
    return html_.str();
  }

 private:
  struct Name {
    double from, to, y;
  };
  struct Mark {
    double x, y;
  };
  static constexpr long kMostRings = 4;
  static constexpr std::size_t kMostLines = 3;

  void draw_contents() {
    html_.element("title", {{"id", chart_.id + "-title"}}, chart_.title);
    html_.element("desc", {{"id", chart_.id + "-desc"}}, chart_.description);
    draw_clip();
    for (std::size_t i = 0; i < chart_.bands.size(); ++i) draw_band(chart_.bands[i], i);
    draw_x_axis();
    draw_y_axis();
    for (const ChartSeries& series : chart_.series) draw_series(series);
    for (std::size_t i = chart_.series.size(); i-- > 0;) draw_names(chart_.series[i]);
    draw_legend();
  }

  /// The axis's own ticks, otherwise about `count` round numbers.
  static std::vector<Tick> ticks_of(const ChartAxis& axis, int count) {
    if (axis.logarithmic && axis.starts_at_zero) {
      std::vector<Tick> ticks = log_ticks(axis.from, axis.to);
      // The first decade stands for all between it and 0.
      std::erase_if(ticks, [&](const Tick& tick) { return tick.value < axis.from * 9.99; });
      ticks.insert(ticks.begin(), {axis.from, "0"});
      return ticks;
    }
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
  double bottom() const { return bottom_; }
  double at_x(double value) const { return left_ + share(chart_.x, value) * (right() - left_); }
  double at_y(double value) const { return bottom() - share(chart_.y, value) * (bottom() - top_); }

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
    html_.empty("rect", {{"x", number(left_)},
                         {"y", number(top_ - 4)},
                         {"width", number(right() - left_)},
                         {"height", number(bottom() - top_ + 8)}});
  }

  void draw_band(const ChartBand& band, std::size_t index) {
    const double from = std::clamp(band.from, chart_.x.from, chart_.x.to);
    const double to = std::clamp(band.to, chart_.x.from, chart_.x.to);
    if (!(to > from)) return;
    const double x1 = at_x(from), x2 = at_x(to);
    html_.empty("rect", {{"class", fmt::format("band band-{}", index % 2)},
                         {"x", number(x1)},
                         {"y", number(top_)},
                         {"width", number(x2 - x1)},
                         {"height", number(bottom() - top_)}});
    if (band.to <= chart_.x.to) line("band-edge", x2, top_, x2, bottom());
    if (x2 - x1 > kCharacter * text_length(band.label)) {
      text("band-label", (x1 + x2) / 2, top_ + 15, "middle", band.label);
    }
  }

  void draw_x_axis() {
    for (const Tick& tick : ticks_of(chart_.x, std::clamp(int((right() - left_) / 70), 3, 10))) {
      const double x = at_x(tick.value);
      line("tick", x, bottom(), x, bottom() + 5);
      text("tick-label", x, bottom() + 19, "middle", tick.label);
    }
    line("axis", left_, bottom(), right(), bottom());
    for (std::size_t i = 0; i < x_label_.size(); ++i)
      text("axis-label", (left_ + right()) / 2,
           chart_.height - 8.0 - kLine * double(x_label_.size() - 1 - i), "middle", x_label_[i]);
  }

  void draw_y_axis() {
    for (const Tick& tick : ticks_of(chart_.y, 5)) {
      const double at = at_y(tick.value);
      if (tick.label.empty()) {
        line("tick", left_ - 3, at, left_, at);
        continue;
      }
      line("grid-line", left_, at, right(), at);
      text("tick-label", left_ - 8, at + 4, "end", tick.label);
    }
    line("axis", left_, top_, left_, bottom());
    const double middle = (top_ + bottom()) / 2;
    for (std::size_t i = 0; i < y_label_.size(); ++i)
      html_.element("text",
                    {{"class", "axis-label"},
                     {"transform", fmt::format("translate({} {}) rotate(-90)",
                                               number(16 + kLine * double(i)), number(middle))},
                     {"text-anchor", "middle"}},
                    y_label_[i]);
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
    const double radius = chart_.marker_radius;
    const std::string name = fmt::format("marker marker-{}", series.style);
    if (series.style % 3 == 1) {
      html_.empty("circle",
                  {{"class", name}, {"cx", number(x)}, {"cy", number(y)}, {"r", number(radius)}});
      return;
    }
    html_.empty("rect",
                {{"class", name},
                 {"x", number(x - radius)},
                 {"y", number(y - radius)},
                 {"width", number(2 * radius)},
                 {"height", number(2 * radius)},
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
      if (i < series.point_keys.size()) {
        attributes.push_back({"data-key", series.point_keys[i]});
        attributes.push_back({"data-x", fmt::format("{:.9g}", x)});
        attributes.push_back({"data-y", fmt::format("{:.9g}", is_zero(y) ? 0 : y)});
      }
      const Tag group(html_, "g", attributes);
      if (i < series.point_labels.size()) html_.element("title", series.point_labels[i]);
      const std::string name = fmt::format("error-bar marker-{}", series.style);
      if (const double half = value(series.x_error, i); half > 0)
        line(name.c_str(), at_x(std::max(x - half, chart_.x.from)), at_y(y), at_x(x + half),
             at_y(y));
      if (const double half = value(series.y_error, i); half > 0)
        line(name.c_str(), at_x(x), at_y(std::max(y - half, chart_.y.from)), at_x(x),
             at_y(y + half));
      // A point that covers another is drawn as a ring around it.
      const auto close = std::ranges::count_if(marks_, [&](const Mark& other) {
        return std::abs(other.x - at_x(x)) < 4 && std::abs(other.y - at_y(y)) < 4;
      });
      marks_.push_back({at_x(x), at_y(y)});
      if (close == 0)
        draw_marker(series, at_x(x), at_y(y));
      else
        draw_ring(series, at_x(x), at_y(y),
                  chart_.marker_radius + 3.0 * double(std::min<long>(close, kMostRings)));
    }
  }

  /// Whether a point without any error lies at the start of the axis.
  bool is_zero(double y) const { return chart_.y.starts_at_zero && y <= chart_.y.from; }

  void draw_ring(const ChartSeries& series, double x, double y, double radius) {
    html_.empty("circle", {{"class", fmt::format("marker ring marker-{}", series.style)},
                           {"cx", number(x)},
                           {"cy", number(y)},
                           {"r", number(radius)},
                           {"fill", "none"}});
  }

  void draw_names(const ChartSeries& series) {
    if (!series.markers) return;
    for (std::size_t i = 0; i < std::min(series.x.size(), series.point_names.size()); ++i)
      if (is_shown(series.x[i], series.y[i]))
        draw_name(series.point_names[i], at_x(series.x[i]), at_y(series.y[i]));
  }

  /// In the first free place around the point, or farther off with a line to it.
  void draw_name(const std::string& name, double x, double y) {
    constexpr double kAway = 8, kUp = -5, kDown = 14, kHeight = 12;
    const double width = kNameCharacter * text_length(name);
    const Name places[] = {
        {x - kAway - width, x - kAway, y + kDown},     {x + kAway, x + kAway + width, y + kDown},
        {x + kAway, x + kAway + width, y + kUp},       {x - kAway - width, x - kAway, y + kUp},
        {x - width / 2, x + width / 2, y + kDown + 4}, {x - width / 2, x + width / 2, y + kUp - 5}};
    const auto is_free = [&](const Name& place) {
      const bool outside = place.from < left_ || place.to > right() || place.y > bottom() ||
                           place.y - kHeight < top_;
      const auto covers = [&](const Name& other) {
        return place.from < other.to && other.from < place.to &&
               std::abs(place.y - other.y) < kHeight + 1;
      };
      const auto hides = [&](const Mark& mark) {
        return place.from < mark.x + 5 && mark.x - 5 < place.to && place.y - kHeight < mark.y + 4 &&
               mark.y - 4 < place.y;
      };
      return !outside && std::ranges::none_of(names_, covers) &&
             std::ranges::none_of(marks_, hides);
    };
    const auto draw_at = [&](const Name& place) {
      names_.push_back(place);
      text("point-name", place.from, place.y, "start", name);
    };
    for (const Name& place : places)
      if (is_free(place)) return draw_at(place);
    constexpr int kDirections = 16;
    for (double away = 18; away < 90; away += 9)
      for (int i = 0; i < kDirections; ++i) {
        const double angle = 2 * kPi * (i + 0.5) / kDirections, across = std::cos(angle),
                     down = std::sin(angle);
        const double middle = x + away * across + width / 2 * across, height = y + away * down;
        const Name place{middle - width / 2, middle + width / 2, height + kHeight / 3};
        if (!is_free(place)) continue;
        line("leader", x + chart_.marker_radius * across, y + chart_.marker_radius * down,
             middle - width / 2 * across, height - 6 * down);
        return draw_at(place);
      }
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

  /// Where each series is named, and last how far down the legend goes. A full line goes on in the next.
  std::vector<Mark> legend_places() const {
    std::vector<Mark> places;
    double x = kLeft, y = 0;
    for (const ChartSeries& series : chart_.series) {
      const double width = 44 + kCharacter * text_length(series.label) + 28;
      if (x > kLeft && x + width - 28 > chart_.width) x = kLeft, y += kLine;
      places.push_back({x, y});
      x += width;
    }
    places.push_back({x, y});
    return places;
  }

  void draw_legend() {
    const std::vector<Mark> places = legend_places();
    for (std::size_t i = 0; i < chart_.series.size(); ++i) {
      const ChartSeries& series = chart_.series[i];
      const auto [x, y] = places[i];
      const LineStyle& style = line_style(series);
      if (series.markers)
        draw_marker(series, x + 18, y + 14);
      else
        html_.empty("line", {{"class", style.name},
                             {"x1", number(x)},
                             {"y1", number(y + 14)},
                             {"x2", number(x + 36)},
                             {"y2", number(y + 14)},
                             {"stroke-dasharray", style.dashes},
                             {"stroke-width", style.width}});
      text("legend", x + 44, y + 18, "start", series.label);
    }
  }

  /// In lines that fit into `room`.
  static std::vector<std::string> wrapped(const std::string& words, double room) {
    std::vector<std::string> lines(1);
    for (std::size_t at = 0; at < words.size();) {
      const std::size_t end = std::min(words.find(' ', at), words.size());
      const std::string word = words.substr(at, end - at);
      const bool fits = kCharacter * (text_length(lines.back()) + 1 + text_length(word)) <= room;
      if (!lines.back().empty() && !fits && lines.size() < kMostLines) lines.emplace_back();
      lines.back() += (lines.back().empty() ? "" : " ") + word;
      at = end + 1;
    }
    return lines;
  }

  const Chart& chart_;
  Html html_;
  double left_ = kLeft, top_ = kTop, bottom_ = 0;
  std::vector<std::string> x_label_, y_label_;
  std::vector<Mark> marks_;  ///< points that are drawn
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
