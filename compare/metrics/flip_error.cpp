#include "compare/metrics/flip_error.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <utility>

#include "compare/metrics/flip_kernels.hpp"
#include "core/aligned.hpp"
#include "core/scratch_memory.hpp"

namespace lobelia {
namespace {

// Columns of a tile: few enough to keep a filter's rows in the first cache, and all planes of both pictures in the
// second. Rows: enough to filter the rows around it again at little cost, few enough to give every processor some.
constexpr int kTileWidth = 256, kTileHeight = 256;

/// The smallest rectangle around pixels.
struct FlipArea {
  int left = std::numeric_limits<int>::max(), right = 0, top = left, bottom = 0;

  /// Columns [first, end) of row y. Rows are added from the top.
  void add(int y, int first, int end) {
    left = std::min(left, first);
    right = std::max(right, end);
    top = std::min(top, y);
    bottom = y + 1;
  }
  FlipTile tile() const {
    return right == 0 ? FlipTile{0, 0, 0, 0} : FlipTile{left, top, right - left, bottom - top};
  }
};

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

/// The smallest area with all pixels that are not 0; the whole picture if there are no pixels.
FlipTile area_of(std::span<const std::uint8_t> pixels, int width, int height) {
  if (pixels.empty()) return {0, 0, width, height};
  FlipArea area;
  for (int y = 0; y < height; ++y) {
    const auto row = pixels.subspan(std::size_t(y) * std::size_t(width), std::size_t(width));
    const auto is_set = [](std::uint8_t pixel) { return pixel != 0; };
    const auto first = std::ranges::find_if(row, is_set);
    if (first == row.end()) continue;
    const auto last = std::find_if(row.rbegin(), row.rend(), is_set);
    area.add(y, int(first - row.begin()), int(row.rend() - last));
  }
  return area.tile();
}

/// The part of the tile that has a pixel, within `radius`, where the two pictures differ. Beyond it there is no error.
FlipTile differing_part(const DisplayLight& a, const DisplayLight& b, const FlipTile& tile,
                        int radius) {
  const int left = std::max(0, tile.left - radius), top = std::max(0, tile.top - radius),
            right = std::min(a.width(), tile.left + tile.width + radius),
            bottom = std::min(a.height(), tile.top + tile.height + radius);
  std::vector<float> rgb_a(3 * std::size_t(right - left)), rgb_b(rgb_a);
  FlipArea area;
  for (int y = top; y < bottom; ++y) {
    a.fill(y, left, rgb_a);
    b.fill(y, left, rgb_b);
    const auto first = std::ranges::mismatch(rgb_a, rgb_b).in1;
    if (first == rgb_a.end()) continue;
    const auto last = std::mismatch(rgb_a.rbegin(), rgb_a.rend(), rgb_b.rbegin()).first;
    area.add(y, left + int(first - rgb_a.begin()) / 3, left + int(rgb_a.rend() - last + 2) / 3);
  }
  if (area.right == 0) return {tile.left, tile.top, 0, 0};
  const int x = std::max(area.left - radius, tile.left), y = std::max(area.top - radius, tile.top);
  return {x, y, std::min(area.right + radius, tile.left + tile.width) - x,
          std::min(area.bottom + radius, tile.top + tile.height) - y};
}

}  // namespace

void flip_tile_errors(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                      const FlipTile& tile, std::span<float> errors) {
  std::ranges::fill(errors, 0.0f);
  const FlipTile part =
      differing_part(a, b, tile, std::max(filters.contrast_radius, filters.feature_radius));
  if (part.width == 0) return;
  FlipTileRows rows_a(a, filters, part), rows_b(b, filters, part);
  const std::size_t columns = std::size_t(part.width), padded = flip_padded(columns),
                    of_tile = flip_padded(std::size_t(tile.width));
  std::vector<float> row(padded);
  for (int y = part.top; y < part.top + part.height; ++y) {
    flip_errors(rows_a.next(), rows_b.next(), row.data(), padded);
    std::copy_n(row.data(), columns,
                errors.data() + of_tile * std::size_t(y - tile.top) + (part.left - tile.left));
  }
}

PixelValues flip_map(int width, int height, const FlipTileValues& values_of,
                     std::span<const std::uint8_t> needed) {
  PixelValues map(std::size_t(width) * std::size_t(height));
  const FlipTile area = area_of(needed, width, height);
  const int across = (area.width + kTileWidth - 1) / kTileWidth,
            down = (area.height + kTileHeight - 1) / kTileHeight;
  oneapi::tbb::parallel_for(0, across * down, [&](int i) {
    const int x = i % across * kTileWidth, y = i / across * kTileHeight;
    const FlipTile tile{area.left + x, area.top + y, std::min(kTileWidth, area.width - x),
                        std::min(kTileHeight, area.height - y)};
    const std::size_t columns = std::size_t(tile.width), padded = flip_padded(columns);
    std::vector<float> values(padded * std::size_t(tile.height));
    values_of(tile, values);
    for (int row = 0; row < tile.height; ++row)
      std::copy_n(values.data() + padded * std::size_t(row), columns,
                  map.begin() + std::ptrdiff_t(tile.top + row) * width + tile.left);
    looked_at(columns * std::size_t(tile.height) * sizeof(float));
  });
  return map;
}

PixelValues flip_error_map(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                           std::span<const std::uint8_t> needed) {
  return flip_map(
      a.width(), a.height(),
      [&](const FlipTile& tile, std::span<float> errors) {
        flip_tile_errors(a, b, filters, tile, errors);
      },
      needed);
}

int flip_radius(const MetricInput& input) {
  const FlipFilters filters(float(input.pixels_per_degree));
  return std::max(filters.contrast_radius, filters.feature_radius);
}

}  // namespace lobelia
