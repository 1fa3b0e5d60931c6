// The main metric over the runs, as a small drawing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gallery/cell_changes.hpp"

namespace lobelia::gallery {
namespace {

constexpr double kHeight = 120, kTop = 22, kBottom = 94, kSide = 44;
constexpr double kRunWidth = 84, kMostWidth = 720;
constexpr double kLogarithmicFrom = 30;  // largest by smallest value
constexpr double kMostDrawn = 1e30;

/// What is drawn of a value: an error without its sign.
std::optional<double> drawn(const std::optional<double>& value) {
  if (!value || !(std::abs(*value) <= kMostDrawn)) return std::nullopt;
  return std::abs(*value);
}

class Drawing {
 public:
  Drawing(Html& html, const ShownFarm& farm, const Timeline& line)
      : html_(html), farm_(farm), line_(line), count_(line.points.size()) {
    width_ =
        std::min(kMostWidth, 2 * kSide + kRunWidth * double(std::max<std::size_t>(1, count_ - 1)));
    std::vector<double> all;
    for (const TimePoint& point : line.points)
      for (const auto& value : {drawn(point.value), drawn(point.limit)})
        if (value) all.push_back(*value);
    if (all.empty()) return;
    const auto [low, high] = std::ranges::minmax(all);
    is_logarithmic_ = low > 0 && high > kLogarithmicFrom * low;
    const bool is_likeness = farm.metrics.info(line.metric).more_is_better;
    from_ = is_logarithmic_ ? std::log(low) : is_likeness ? low : 0;
    to_ = is_logarithmic_ ? std::log(high) : high;
  }

  void write() const {
    const Tag figure(html_, "figure", {{"class", "timeline"}});
    html_.element("figcaption",
                  farm_.metrics.info(line_.metric).title +
                      (is_logarithmic_ ? " over the runs, logarithmic" : " over the runs"));
    const Tag svg(html_, "svg",
                  {{"viewBox", fmt::format("0 0 {:.0f} {:.0f}", width_, kHeight)},
                   {"width", fmt::format("{:.0f}", width_)},
                   {"height", fmt::format("{:.0f}", kHeight)},
                   {"role", "img"},
                   {"aria-label", words()}});
    write_limit();
    write_line();
    for (std::size_t i = 0; i < count_; ++i) write_point(i);
  }

 private:
  double x(std::size_t i) const {
    return count_ < 2 ? width_ / 2 : kSide + double(i) * (width_ - 2 * kSide) / double(count_ - 1);
  }
  double y(double value) const {
    const double at = is_logarithmic_ ? std::log(value) : value;
    const double share = to_ > from_ ? (at - from_) / (to_ - from_) : 0.5;
    return kBottom - std::clamp(share, 0.0, 1.0) * (kBottom - kTop);
  }
  std::string text(double value) const { return farm_.metrics.text(line_.metric, value); }

  std::string words_of(const TimePoint& point) const {
    return fmt::format("{}, {}: {}", point.date, point.name,
                       point.value ? text(*point.value) : "no value");
  }

  std::string words() const {
    std::string words =
        farm_.engine_title(line_.engine) + ", " + farm_.metrics.info(line_.metric).title + ". ";
    for (const TimePoint& point : line_.points) words += words_of(point) + ". ";
    const auto& limit = line_.points.back().limit;
    return words + (limit ? "Limit " + text(*limit) + "." : "There is no limit.");
  }

  /// A step where the limit was another one.
  void write_limit() const {
    const double half = count_ < 2 ? kRunWidth / 2 : (x(1) - x(0)) / 2;
    for (std::size_t i = 0; i < count_; ++i) {
      const auto limit = drawn(line_.points[i].limit);
      if (!limit) continue;
      const std::string at = fmt::format("{:.1f}", y(*limit));
      html_.empty("line", {{"class", "limit"},
                           {"x1", fmt::format("{:.1f}", std::max(0.0, x(i) - half))},
                           {"x2", fmt::format("{:.1f}", std::min(width_, x(i) + half))},
                           {"y1", at},
                           {"y2", at}});
    }
    const auto limit = drawn(line_.points.back().limit);
    if (!limit) return;
    html_.element(
        "text", {{"class", "limit-label"}, {"x", "2"}, {"y", fmt::format("{:.1f}", y(*limit) - 5)}},
        "limit " + text(*line_.points.back().limit));
  }

  void write_line() const {
    std::string path;
    bool is_open = false;
    for (std::size_t i = 0; i < count_; ++i) {
      const auto value = drawn(line_.points[i].value);
      if (value) path += fmt::format("{}{:.1f} {:.1f}", is_open ? "L" : "M", x(i), y(*value));
      is_open = value.has_value();
    }
    if (!path.empty()) html_.empty("path", {{"class", "run-line"}, {"d", path}});
  }

  void write_point(std::size_t i) const {
    const TimePoint& point = line_.points[i];
    const bool is_last = i + 1 == count_;
    if (const auto value = drawn(point.value)) {
      const Tag dot(html_, "circle",
                    {{"class", is_last ? "now" : "then"},
                     {"cx", fmt::format("{:.1f}", x(i))},
                     {"cy", fmt::format("{:.1f}", y(*value))},
                     {"r", "4"}});
      html_.element("title", words_of(point));
    }
    // As many dates as there is room for, counted from the last.
    const double step = count_ < 2 ? kRunWidth : x(1) - x(0);
    const auto every = std::size_t(std::max(1.0, std::ceil(kRunWidth / std::max(step, 1.0))));
    if ((count_ - 1 - i) % every != 0) return;
    html_.element("text",
                  {{"class", "run-label"},
                   {"text-anchor", "middle"},
                   {"x", fmt::format("{:.1f}", x(i))},
                   {"y", fmt::format("{:.0f}", kHeight - 6)}},
                  point.date);
  }

  Html& html_;
  const ShownFarm& farm_;
  const Timeline& line_;
  std::size_t count_;
  double width_ = 0, from_ = 0, to_ = 1;
  bool is_logarithmic_ = false;
};

}  // namespace

void write_timeline(Html& html, const ShownFarm& farm, const Timeline& line) {
  if (!line.points.empty()) Drawing(html, farm, line).write();
}

}  // namespace lobelia::gallery
