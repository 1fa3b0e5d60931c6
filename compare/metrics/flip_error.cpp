#include "compare/metrics/flip_error.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "compare/metrics/flip_kernels.hpp"
#include "core/aligned.hpp"

namespace lobelia {
namespace {

// Columns of a tile: few enough to keep a filter's rows in the first cache, and all planes of both pictures in the
// second. Rows: enough to filter the rows around it again at little cost, few enough to give every processor some.
constexpr int kTileWidth = 256, kTileHeight = 256;

int tiles_across(int width) { return (width + kTileWidth - 1) / kTileWidth; }
int tiles_down(int height) { return (height + kTileHeight - 1) / kTileHeight; }

/// On many threads, for all tiles of the area: errors_of(tile, errors), then visit(i, x, y, row) for each row of errors, from the
/// top. i is the tile's index; x and y are the row's first pixel.
template <class ErrorsOf, class Visit>
void for_each_row_of_tiles(const FlipTile& area, const ErrorsOf& errors_of, const Visit& visit) {
  const int across = tiles_across(area.width);
  oneapi::tbb::parallel_for(0, across * tiles_down(area.height), [&](int i) {
    const int x = i % across * kTileWidth, y = i / across * kTileHeight;
    const int left = area.left + x, top = area.top + y;
    const FlipTile tile{left, top, std::min(kTileWidth, area.width - x),
                        std::min(kTileHeight, area.height - y)};
    const std::size_t columns = std::size_t(tile.width), padded = flip_padded(columns);
    std::vector<float> errors(padded * std::size_t(tile.height));
    errors_of(tile, std::span<float>(errors));
    for (int row = 0; row < tile.height; ++row)
      visit(std::size_t(i), left, top + row,
            std::span<const float>(errors).subspan(padded * std::size_t(row), columns));
  });
}

/// The filtered rows of a tile, from the top. Pixels of the picture's border repeat beyond it. Holds no more rows than
/// the filters are high, so that they stay in the cache.
class FlipTileRows {
 public:
  /// The filters and the shown picture must outlive it.
  FlipTileRows(const DisplayLight& shown, const FlipFilters& filters, const FlipTile& tile);

  /// The next row: flip_padded(tile.width) pixels, valid until the next call.
  const FlipFiltered& next();

 private:
  /// Planes filtered along the rows, to be filtered down the columns.
  enum Plane { kY, kCx, kCz1, kCz2, kSmooth, kEdge, kPoint, kPlanes };

  float* row(Plane plane, int y);
  void filter_along(int y);

  DisplayLight shown_;
  const FlipFilters& filters_;
  FlipTile tile_;
  int radius_;    ///< of the largest filter
  int filtered_;  ///< rows above this one have been filtered along
  int next_;      ///< row that next() returns
  std::size_t padded_, extended_;
  AlignedFloats memory_;
  float *rgb_, *planes_;
  FlipColours in_;
  FlipFiltered out_;
  std::vector<const float*> taps_;
};

FlipTileRows::FlipTileRows(const DisplayLight& shown, const FlipFilters& filters,
                           const FlipTile& tile)
    : shown_(shown),
      filters_(filters),
      tile_(tile),
      radius_(std::max(filters.contrast_radius, filters.feature_radius)),
      filtered_(std::max(0, tile.top - radius_)),
      next_(tile.top),
      padded_(flip_padded(std::size_t(tile.width))),
      extended_(flip_padded(padded_ + 2 * std::size_t(radius_))) {
  const std::size_t kept = padded_ * (2 * std::size_t(radius_) + 1);
  constexpr std::size_t kIn = 3 + sizeof(in_) / sizeof(float*),
                        kOut = sizeof(out_) / sizeof(float*);
  const std::size_t size = kIn * extended_ + kPlanes * kept + kOut * padded_;
  memory_ = aligned_floats(size);
  float* free = memory_.get();
  const auto take = [&](std::size_t count) { return std::exchange(free, free + count); };
  rgb_ = take(3 * extended_);
  for (float** in : {&in_.y, &in_.cx, &in_.cz, &in_.grey}) *in = take(extended_);
  planes_ = take(kPlanes * kept);
  for (float** out :
       {&out_.y, &out_.cx, &out_.cz_1, &out_.cz_2, &out_.dx, &out_.dy, &out_.ddx, &out_.ddy})
    *out = take(padded_);
}

float* FlipTileRows::row(Plane plane, int y) {
  const int kept = 2 * radius_ + 1;
  return planes_ + padded_ * std::size_t(plane * kept + y % kept);
}

void FlipTileRows::filter_along(int y) {
  // The row is extended by its border pixels, so that no tap needs a test.
  const int first = tile_.left - radius_, count = int(extended_);
  const int left = std::clamp(-first, 0, count),
            right = std::clamp(shown_.width() - first, left, count);
  shown_.fill(y, first + left, {rgb_ + 3 * left, 3 * std::size_t(right - left)});
  for (int i = 0; i < left; ++i) std::copy_n(rgb_ + 3 * left, 3, rgb_ + 3 * i);
  for (int i = right; i < count; ++i) std::copy_n(rgb_ + 3 * (right - 1), 3, rgb_ + 3 * i);
  flip_colours(rgb_, in_, extended_);

  const auto filter = [&](const float* in, std::initializer_list<WeightedSum> sums) {
    const std::size_t taps = sums.begin()->weights.size(), radius = taps / 2;
    taps_.resize(taps);
    for (std::size_t k = 0; k < taps; ++k) taps_[k] = in + std::size_t(radius_) - radius + k;
    weighted_sums(sums, taps_.data(), padded_);
  };
  filter(in_.y, {{filters_.luminance, row(kY, y)}});
  filter(in_.cx, {{filters_.red_green, row(kCx, y)}});
  filter(in_.cz, {{filters_.blue_yellow_1, row(kCz1, y)}, {filters_.blue_yellow_2, row(kCz2, y)}});
  filter(in_.grey, {{filters_.gaussian, row(kSmooth, y)},
                    {filters_.edge, row(kEdge, y)},
                    {filters_.point, row(kPoint, y)}});
}

const FlipFiltered& FlipTileRows::next() {
  const int y = next_++, height = shown_.height();
  for (const int last = std::min(y + radius_, height - 1); filtered_ <= last; ++filtered_)
    filter_along(filtered_);

  const auto filter = [&](Plane plane, std::initializer_list<WeightedSum> sums) {
    const int taps = int(sums.begin()->weights.size()), radius = taps / 2;
    taps_.resize(std::size_t(taps));
    for (int k = 0; k < taps; ++k)
      taps_[std::size_t(k)] = row(plane, std::clamp(y + k - radius, 0, height - 1));
    weighted_sums(sums, taps_.data(), padded_);
  };
  filter(kY, {{filters_.luminance, out_.y}});
  filter(kCx, {{filters_.red_green, out_.cx}});
  filter(kCz1, {{filters_.blue_yellow_1, out_.cz_1}});
  filter(kCz2, {{filters_.blue_yellow_2, out_.cz_2}});
  filter(kEdge, {{filters_.gaussian, out_.dx}});
  filter(kPoint, {{filters_.gaussian, out_.ddx}});
  filter(kSmooth, {{filters_.edge, out_.dy}, {filters_.point, out_.ddy}});
  return out_;
}

/// The smallest area that holds the region.
FlipTile area_of(const MetricInput& input) {
  const int width = input.a.width(), height = input.a.height();
  if (input.region.empty()) return {0, 0, width, height};
  int left = width, right = 0, top = height, bottom = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (input.region[std::size_t(y) * std::size_t(width) + std::size_t(x)] == 0) continue;
      left = std::min(left, x);
      right = std::max(right, x + 1);
      top = std::min(top, y);
      bottom = y + 1;
    }
  return {left, top, std::max(0, right - left), std::max(0, bottom - top)};
}

}  // namespace

void flip_tile_errors(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                      const FlipTile& tile, std::span<float> errors) {
  FlipTileRows rows_a(a, filters, tile), rows_b(b, filters, tile);
  const std::size_t padded = flip_padded(std::size_t(tile.width));
  for (int row = 0; row < tile.height; ++row)
    flip_errors(rows_a.next(), rows_b.next(),
                errors.subspan(padded * std::size_t(row), padded).data(), padded);
}

std::vector<float> flip_map(int width, int height, const FlipTileValues& values_of) {
  std::vector<float> map(std::size_t(width) * std::size_t(height));
  for_each_row_of_tiles({0, 0, width, height}, values_of,
                        [&](std::size_t, int x, int y, std::span<const float> values) {
                          std::ranges::copy(values, map.begin() + std::ptrdiff_t(y) * width + x);
                        });
  return map;
}

std::vector<float> flip_error_map(const DisplayLight& a, const DisplayLight& b,
                                  const FlipFilters& filters) {
  return flip_map(a.width(), a.height(), [&](const FlipTile& tile, std::span<float> errors) {
    flip_tile_errors(a, b, filters, tile, errors);
  });
}

int flip_radius(const MetricInput& input) {
  const FlipFilters filters(float(input.pixels_per_degree));
  return std::max(filters.contrast_radius, filters.feature_radius);
}

void pool_flip_errors(const MetricInput& input, const FlipTileValues& errors_of,
                      std::span<double> values) {
  const FlipTile area = area_of(input);
  struct Sum {
    double sum = 0, largest = 0;
    std::size_t count = 0;
  };
  std::vector<Sum> of_tile(std::size_t(tiles_across(area.width)) *
                           std::size_t(tiles_down(area.height)));
  const auto width = std::size_t(input.a.width());
  for_each_row_of_tiles(area, errors_of,
                        [&](std::size_t tile, int x, int y, std::span<const float> errors) {
                          Sum& in_tile = of_tile[tile];
                          for (std::size_t i = 0; i < errors.size(); ++i) {
                            if (!input.in_region(std::size_t(y) * width + std::size_t(x) + i))
                              continue;
                            in_tile.sum += double(errors[i]);
                            in_tile.largest = std::max(in_tile.largest, double(errors[i]));
                            ++in_tile.count;
                          }
                        });
  // In order of the tiles: the sum must not depend on the number of threads.
  Sum all;
  for (const Sum& one : of_tile)
    all = {all.sum + one.sum, std::max(all.largest, one.largest), all.count + one.count};
  values[0] = all.sum / double(std::max<std::size_t>(all.count, 1));
  values[1] = all.largest;
}

}  // namespace lobelia
