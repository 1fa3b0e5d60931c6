#include "compare/metrics/flip_error.hpp"

#include <hwy/aligned_allocator.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "compare/metrics/flip_kernels.hpp"

namespace lobelia {
namespace {

// Columns of a tile: few enough to keep a filter's rows in the first cache, and all planes of both pictures in the
// second. Rows: enough to filter the rows around it again at little cost, few enough to give every processor some.
constexpr int kTileWidth = 256, kTileHeight = 256;

int tiles_across(int width) { return (width + kTileWidth - 1) / kTileWidth; }
int tiles_down(int height) { return (height + kTileHeight - 1) / kTileHeight; }

/// On many threads, for all tiles: errors_of(tile, errors), then visit(i, x, y, row) for each row of errors, from the
/// top. i is the tile's index; x and y are the row's first pixel.
template <class ErrorsOf, class Visit>
void for_each_row_of_tiles(int width, int height, const ErrorsOf& errors_of, const Visit& visit) {
  const int across = tiles_across(width);
  oneapi::tbb::parallel_for(0, across * tiles_down(height), [&](int i) {
    const int left = i % across * kTileWidth, top = i / across * kTileHeight;
    const FlipTile tile{left, top, std::min(kTileWidth, width - left),
                        std::min(kTileHeight, height - top)};
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
  hwy::AlignedFreeUniquePtr<float[]> memory_;
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
  memory_ = hwy::AllocateAligned<float>(size);
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

}  // namespace

void flip_tile_errors(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                      const FlipTile& tile, std::span<float> errors) {
  FlipTileRows rows_a(a, filters, tile), rows_b(b, filters, tile);
  const std::size_t padded = flip_padded(std::size_t(tile.width));
  for (int row = 0; row < tile.height; ++row)
    flip_errors(rows_a.next(), rows_b.next(),
                errors.subspan(padded * std::size_t(row), padded).data(), padded);
}

std::vector<float> flip_error_map(const DisplayLight& a, const DisplayLight& b,
                                  const FlipFilters& filters) {
  std::vector<float> map(a.pixel_count());
  for_each_row_of_tiles(
      a.width(), a.height(),
      [&](const FlipTile& tile, std::span<float> errors) {
        flip_tile_errors(a, b, filters, tile, errors);
      },
      [&](std::size_t, int x, int y, std::span<const float> errors) {
        std::ranges::copy(errors, map.begin() + std::ptrdiff_t(y) * a.width() + x);
      });
  return map;
}

void pool_flip_errors(int width, int height,
                      const std::function<void(const FlipTile&, std::span<float>)>& errors_of,
                      std::span<double> values) {
  std::vector<double> tile_sum(std::size_t(tiles_across(width)) * std::size_t(tiles_down(height))),
      tile_max(tile_sum);
  for_each_row_of_tiles(width, height, errors_of,
                        [&](std::size_t tile, int, int, std::span<const float> errors) {
                          for (const float error : errors) {
                            tile_sum[tile] += double(error);
                            tile_max[tile] = std::max(tile_max[tile], double(error));
                          }
                        });
  // In order of the tiles: the sum must not depend on the number of threads.
  double sum = 0, largest = 0;
  for (const double value : tile_sum) sum += value;
  for (const double value : tile_max) largest = std::max(largest, value);
  values[0] = sum / std::max(double(width) * double(height), 1.0);
  values[1] = largest;
}

}  // namespace lobelia
