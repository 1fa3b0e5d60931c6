#include "compare/overscan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/cryptomatte.hpp"
#include "compare/layer_types.hpp"

namespace lobelia {
namespace {

/// The data window relative to the first pixel of the display window.
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

/// The intersection; it has no pixels if they are apart.
PixelWindow common(const PixelWindow& a, const PixelWindow& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::max(0, std::min(a.x + a.width, b.x + b.width) - x),
          std::max(0, std::min(a.y + a.height, b.y + b.height) - y)};
}

bool contains(const PixelWindow& window, int x, int y) {
  return x >= window.x && x < window.x + window.width && y >= window.y &&
         y < window.y + window.height;
}

PixelFlags widened(const PixelFlags& mask, const PixelWindow& display, const PixelWindow& window) {
  if (mask.empty()) return {};
  PixelFlags result(std::size_t(area(window)));
  const auto width = std::size_t(display.width);
  for (int y = 0; y < display.height; ++y)
    std::copy_n(mask.begin() + std::ptrdiff_t(width * std::size_t(y)), width,
                result.begin() + std::ptrdiff_t{window.width} * (y - window.y) - window.x);
  return result;
}

ComparisonOptions on_window(ComparisonOptions options, const PixelWindow& display,
                            const PixelWindow& window) {
  for (auto* part : {&options.mask, &options.surfaces, &options.ignored})
    *part = widened(*part, display, window);
  if (options.tolerance)
    options.tolerance->edges = widened(options.tolerance->edges, display, window);
  return options;
}

struct Unshared {
  std::int64_t only_a = 0, only_b = 0;  ///< pixels that are not 0 where the other has no data
  bool identical = true;                ///< and finite
};

/// Compares the pixels of the window that lie outside the display window.
Unshared compare_outside(const Image& a, const Image& b, const PicturePair& pair,
                         const PixelWindow& window) {
  Unshared result;
  const PixelWindow display = at_origin(pair.a.source.display);
  const PixelWindow data_a = relative_data(pair.a.source), data_b = relative_data(pair.b.source);
  const auto is_black = [](std::span<const float, 3> pixel) {
    return std::ranges::count(pixel, 0.0f) == 3;
  };
  for (int y = window.y; y < window.y + window.height; ++y)
    for (int x = window.x; x < window.x + window.width; ++x) {
      if (contains(display, x, y)) continue;
      const auto in_a = a.pixel(x - window.x, y - window.y),
                 in_b = b.pixel(x - window.x, y - window.y);
      result.only_a += !contains(data_b, x, y) && !is_black(in_a);
      result.only_b += !contains(data_a, x, y) && !is_black(in_b);
      result.identical = result.identical && std::ranges::equal(in_a, in_b) &&
                         std::ranges::all_of(in_a, [](float v) { return std::isfinite(v); });
    }
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

Image all_data(const Picture& picture, const PixelWindow& window) {
  if (picture.overscan.pixel_count() == 0)
    return place(picture.image, at_origin(picture.source.display), window);
  return place(picture.overscan, relative_data(picture.source), window);
}

LayerComparison compare_overscan(const std::string& layer, const PicturePair& pair,
                                 const Overscan& overscan, const ComparisonOptions& options) {
  const PixelWindow& window = overscan.window;
  LayerComparison result{layer, pair.a.source, pair.b.source};
  result.overscan = window;
  result.type = type_of_layers(pair.a.source, pair.b.source, options);
  result.problem = window_problem("the window of all data", window);
  if (!result.problem.empty()) return result;
  Image a = all_data(pair.a, window), b = all_data(pair.b, window);
  ComparisonOptions on_all = on_window(options, at_origin(pair.a.source.display), window);
  take_part(a, b, on_all);
  const Unshared outside = compare_outside(a, b, pair, window);
  if (outside.only_a + outside.only_b > 0)
    result.problem = fmt::format("pixels that are not 0 where the other has none: {} of a, {} of b",
                                 outside.only_a, outside.only_b);
  else if (outside.identical && result.type != LayerType::kIdentifier)  // of which -0 is no 0
    result.identical = true;
  else
    result.comparison = compare_values(a, b, pair.a.source, pair.b.source, result.type, on_all);
  return result;
}

LayerComparison compare_cryptomatte_overscan(const CryptomatteRank& rank,
                                             const std::filesystem::path& file_a,
                                             const std::filesystem::path& file_b,
                                             const PicturePairSource& pair,
                                             const Overscan& overscan,
                                             const ComparisonOptions& options) {
  const PixelWindow& window = overscan.window;
  LayerComparison result{rank.name, pair.a, pair.b};
  result.overscan = window;
  result.type = LayerType::kIdentifier;
  result.problem = window_problem("the window of all data", window);
  if (!result.problem.empty()) return result;
  const ComparisonOptions on_all = on_window(options, at_origin(pair.a.display), window);
  result.comparison =
      compare_cryptomattes(read_cryptomatte(file_a, pair.a, rank, on_all, window),
                           read_cryptomatte(file_b, pair.b, rank, on_all, window), on_all);
  return result;
}

}  // namespace lobelia
