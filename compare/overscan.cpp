#include "compare/overscan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lobelia {
namespace {

/// The data window, seen from the first pixel of the display window.
PixelWindow relative_data(const PictureSource& source) {
  return {source.data.x - source.display.x, source.data.y - source.display.y, source.data.width,
          source.data.height};
}

PixelWindow at_origin(const PixelWindow& window) { return {0, 0, window.width, window.height}; }

PixelWindow around(const PixelWindow& a, const PixelWindow& b) {
  const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x,
          std::max(a.y + a.height, b.y + b.height) - y};
}

std::int64_t area(const PixelWindow& window) { return std::int64_t{window.width} * window.height; }

/// Without pixels where they are apart.
PixelWindow common(const PixelWindow& a, const PixelWindow& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::max(0, std::min(a.x + a.width, b.x + b.width) - x),
          std::max(0, std::min(a.y + a.height, b.y + b.height) - y)};
}

bool contains(const PixelWindow& window, int x, int y) {
  return x >= window.x && x < window.x + window.width && y >= window.y &&
         y < window.y + window.height;
}

Image all_data(const Picture& picture, const PixelWindow& window) {
  if (picture.overscan.pixel_count() == 0)
    return place(picture.image, at_origin(picture.source.display), window);
  return place(picture.overscan, relative_data(picture.source), window);
}

std::vector<std::uint8_t> widened(const std::vector<std::uint8_t>& mask, const PixelWindow& display,
                                  const PixelWindow& window) {
  if (mask.empty()) return {};
  std::vector<std::uint8_t> result(std::size_t(area(window)));
  const auto width = std::size_t(display.width);
  for (int y = 0; y < display.height; ++y)
    std::copy_n(mask.begin() + std::ptrdiff_t(width * std::size_t(y)), width,
                result.begin() + std::ptrdiff_t{window.width} * (y - window.y) - window.x);
  return result;
}

}  // namespace

std::optional<Overscan> find_overscan(const PictureSource& a, const PictureSource& b) {
  const PixelWindow display = at_origin(a.display);
  const PixelWindow data_a = relative_data(a), data_b = relative_data(b);
  if (is_inside(data_a, display) && is_inside(data_b, display)) return std::nullopt;
  const auto outside = [&](const PixelWindow& data) {
    return area(data) - area(common(data, display));
  };
  return Overscan{around(around(data_a, data_b), display),
                  outside(data_a) + outside(data_b) - outside(common(data_a, data_b))};
}

OverscanPictures on_window(const Picture& a, const Picture& b, const PixelWindow& window) {
  OverscanPictures result{all_data(a, window), all_data(b, window)};
  const PixelWindow display = at_origin(a.source.display);
  const PixelWindow data_a = relative_data(a.source), data_b = relative_data(b.source);
  for (int y = window.y; y < window.y + window.height; ++y)
    for (int x = window.x; x < window.x + window.width; ++x) {
      if (contains(display, x, y)) continue;
      const auto in_a = result.a.pixel(x - window.x, y - window.y),
                 in_b = result.b.pixel(x - window.x, y - window.y);
      const auto is_empty = [](std::span<const float, 3> pixel) {
        return pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 0;
      };
      result.only_a += !contains(data_b, x, y) && !is_empty(in_a);
      result.only_b += !contains(data_a, x, y) && !is_empty(in_b);
      for (std::size_t c = 0; c < 3; ++c)
        result.identical &= in_a[c] == in_b[c] && std::isfinite(in_a[c]);
    }
  return result;
}

ComparisonOptions on_window(ComparisonOptions options, const PixelWindow& display,
                            const PixelWindow& window) {
  options.mask = widened(options.mask, display, window);
  if (options.tolerance)
    options.tolerance->edges = widened(options.tolerance->edges, display, window);
  return options;
}

}  // namespace lobelia
