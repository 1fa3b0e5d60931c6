#include "compare/metrics/flip_error.hpp"

#include <oneapi/tbb/cache_aligned_allocator.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>

#include "base/system/scratch_memory.hpp"
#include "compare/metrics/flip_kernels.hpp"

namespace lobelia {
namespace {

// Columns of a tile: few enough to keep a filter's rows in the first cache, and all planes of both pictures in the
// second. Of pictures in files every row of a tile brings the pages around it: the fewer tiles, the fewer pages.
// Rows: enough to filter the rows around it again at little cost, few enough to give every processor some.
constexpr int kTileWidth = 128, kTileWidthInFiles = 256, kTileHeight = 544;

/// The smallest rectangle around pixels.
struct FlipArea {
  int left = std::numeric_limits<int>::max(), right = 0, top = left, bottom = 0;

  /// Columns [first, end) of row y.
  void add(int y, int first, int end) {
    left = std::min(left, first);
    right = std::max(right, end);
    top = std::min(top, y);
    bottom = std::max(bottom, y + 1);
  }
  FlipTile tile() const {
    return right == 0 ? FlipTile{0, 0, 0, 0} : FlipTile{left, top, right - left, bottom - top};
  }
};

/// From the beginning of a line of the cache on.
template <class T>
using Aligned = std::vector<T, oneapi::tbb::cache_aligned_allocator<T>>;

/// One picture's rows of a tile that have been filtered along. Pixels of the picture's border repeat beyond it. Holds no
/// more rows than a band and the filters around it are high, so that they stay in the cache.
class FlipTileRows {
 public:
  FlipTileRows(const DisplayLight& shown, const FlipFilters& filters, const FlipTile& tile);

  /// The colours of a row of the picture, to be filtered along.
  FlipColours colours(int y);
  /// Its light, with `radius` pixels before the tile and as many after it.
  std::span<const float> light() const {
    return std::span(rgb_, 3 * extended_).subspan(3 * (beside_ - std::size_t(filters_.radius())));
  }
  const FlipRows& filtered() const { return rows_; }

 private:
  const DisplayLight& shown_;
  const FlipFilters& filters_;
  std::size_t beside_;  ///< pixels of input before the tile, and after it
  int first_;           ///< column of the picture at which a row of input begins
  std::size_t extended_;
  Aligned<float> rgb_memory_;
  Aligned<double> memory_;
  float* rgb_;
  FlipColours in_;
  FlipRows rows_;
};

FlipTileRows::FlipTileRows(const DisplayLight& shown, const FlipFilters& filters,
                           const FlipTile& tile)
    : shown_(shown),
      filters_(filters),
      beside_(flip_padded(std::size_t(filters.radius()) + 1)),
      first_(tile.left - int(beside_)) {
  const std::size_t padded = flip_padded(std::size_t(tile.width));
  extended_ = padded + 2 * beside_;
  rows_.kept = 2 * std::size_t(filters.radius()) + kFlipBand;
  rows_.blocks = padded / kFlipBlock;
  rgb_memory_.resize(3 * extended_);
  rgb_ = rgb_memory_.data();
  const std::size_t filtered = FlipRows::size(rows_.kept, rows_.blocks);
  memory_.resize(filtered + 3 * extended_);
  rows_.values = memory_.data();
  double* const in = memory_.data() + filtered;  // kFlipBlock doubles are two lines of the cache
  in_ = {in, in + extended_, in + 2 * extended_};
}

FlipColours FlipTileRows::colours(int y) {
  // The row is extended by its border pixels, so that no tap needs a test.
  const int count = int(extended_);
  const int left = std::clamp(-first_, 0, count),
            right = std::clamp(shown_.width() - first_, left, count);
  shown_.fill(y, first_ + left, {rgb_ + 3 * left, 3 * std::size_t(right - left)});
  for (int i = 0; i < left; ++i) std::copy_n(rgb_ + 3 * left, 3, rgb_ + 3 * i);
  for (int i = right; i < count; ++i) std::copy_n(rgb_ + 3 * (right - 1), 3, rgb_ + 3 * i);
  flip_colours(rgb_, in_, extended_);
  // A row of the picture is on other pages than the one before, where the processor does not expect it.
  if (y + 2 < shown_.height()) {
    const float* next = shown_.image().pixel(first_ + left, y + 2).data();
    for (int i = 0; i < 3 * (right - left); i += 16) __builtin_prefetch(next + i);
  }
  return {in_.y + beside_, in_.cx + beside_, in_.cz + beside_};
}

/// Where the rows of a tile may differ: for each block of columns the end of the last band of rows in which they may, within
/// the filters' reach. A row that differs stands for a band, so that few are compared.
class FlipDifferences {
 public:
  FlipDifferences(std::size_t blocks, int radius)
      : end_(blocks, std::numeric_limits<int>::min() / 2), radius_(radius) {}

  /// Rows are added from the top.
  void add(int y, std::span<const float> a, std::span<const float> b) {
    const std::size_t block = 3 * kFlipBlock, reach = block + 6 * std::size_t(radius_);
    for (std::size_t i = 0; i < end_.size(); ++i)
      if (y >= end_[i] &&
          std::memcmp(a.data() + i * block, b.data() + i * block, reach * sizeof(float)) != 0)
        end_[i] = y + int(kFlipBand);
  }
  /// Whether rows from y on may have an error in the block. Rows within reach of them have been added.
  bool reach(std::size_t block, int y) const { return end_[block] > y - radius_; }

 private:
  std::vector<int> end_;
  int radius_;
};

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

}  // namespace

FlipTile differing_part(const Image& a, const Image& b, const FlipTile& tile, int radius) {
  const int left = std::max(0, tile.left - radius), top = std::max(0, tile.top - radius),
            right = std::min(a.width(), tile.left + tile.width + radius),
            bottom = std::min(a.height(), tile.top + tile.height + radius);
  FlipArea area;
  // Adds what differs in columns [first, end) of a row.
  const auto add = [&](int y, int first, int end) {
    const auto values = [=](const Image& image) {
      return image.values().subspan(
          3 * (std::size_t(y) * std::size_t(image.width()) + std::size_t(first)),
          3 * std::size_t(end - first));
    };
    const std::span<const float> of_a = values(a), of_b = values(b);
    if (std::memcmp(of_a.data(), of_b.data(), of_a.size_bytes()) == 0) return;
    const auto from = std::ranges::mismatch(of_a, of_b).in1;
    if (from == of_a.end()) return;
    const auto last = std::mismatch(of_a.rbegin(), of_a.rend(), of_b.rbegin()).first;
    area.add(y, first + int(from - of_a.begin()) / 3, first + int(of_a.rend() - last + 2) / 3);
  };
  const auto looked_at_both = [bytes = 3 * sizeof(float) * std::size_t(right - left)] {
    looked_at_row(bytes);
    looked_at_row(bytes);
  };
  int y = top, end = bottom;
  for (; y < bottom && area.right == 0; ++y) {
    add(y, left, right);
    looked_at_both();
  }
  for (; y < end && area.bottom <= y; --end) {
    add(end - 1, left, right);
    looked_at_both();
  }
  // Between its first and its last row, the area can only become wider.
  for (; y < end && (area.left > left || area.right < right); ++y) {
    add(y, left, area.left);
    add(y, area.right, right);
    looked_at_both();
  }
  if (area.right == 0) return {tile.left, tile.top, 0, 0};
  const int x = std::max(area.left - radius, tile.left);
  y = std::max(area.top - radius, tile.top);
  return {x, y, std::min(area.right + radius, tile.left + tile.width) - x,
          std::min(area.bottom + radius, tile.top + tile.height) - y};
}

void flip_tile_logs(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                    const FlipTile& tile, const FlipTile& part, std::span<float> logs) {
  const int radius = filters.radius(), height = a.height(), bottom = part.top + part.height;
  FlipTileRows rows_a(a, filters, part), rows_b(b, filters, part);
  const std::size_t blocks = rows_a.filtered().blocks, kept = rows_a.filtered().kept,
                    around = kFlipBand + 2 * std::size_t(radius),
                    of_tile = flip_padded(std::size_t(tile.width));
  FlipDifferences differences(blocks, radius);
  std::vector<std::size_t> offsets(around);
  std::vector<float> band(kFlipBand * blocks * kFlipBlock);
  int filtered = std::max(0, part.top - radius);
  for (int y = part.top; y < bottom; y += int(kFlipBand)) {
    const int rows = std::min(int(kFlipBand), bottom - y);
    for (const int end = std::min(y + rows + radius, height); filtered < end; ++filtered) {
      flip_filter_along(filters, rows_a.colours(filtered), rows_b.colours(filtered),
                        rows_a.filtered(), rows_b.filtered(), std::size_t(filtered) % kept);
      differences.add(filtered, rows_a.light(), rows_b.light());
    }
    for (std::size_t i = 0; i < around; ++i) {
      const int row = std::clamp(y + int(i) - radius, 0, filtered - 1);
      offsets[i] = std::size_t(row) % kept * kFlipBlock;
    }
    const FlipTapsDown taps{offsets.data(), std::size_t(radius), std::size_t(rows)};
    std::ranges::fill(band, kNoFlip);
    for (std::size_t block = 0; block < blocks; ++block)
      if (differences.reach(block, y))
        flip_block_logs(filters, rows_a.filtered(), rows_b.filtered(), block, taps,
                        band.data() + block * kFlipBlock, blocks * kFlipBlock);
    for (int row = 0; row < rows; ++row)
      std::copy_n(
          band.data() + std::size_t(row) * blocks * kFlipBlock, part.width,
          logs.data() + of_tile * std::size_t(y + row - tile.top) + (part.left - tile.left));
  }
}

void flip_tile_errors(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                      const FlipTile& tile, std::span<float> errors) {
  std::ranges::fill(errors, kNoFlip);
  const FlipTile part = differing_part(a.image(), b.image(), tile, filters.radius());
  if (part.width > 0) flip_tile_logs(a, b, filters, tile, part, errors);
  flip_errors_of(errors.data(), errors.size());
}

PixelValues flip_map(int width, int height, const FlipTileValues& values_of,
                     std::span<const std::uint8_t> needed) {
  PixelValues map(std::size_t(width) * std::size_t(height));
  const FlipTile area = area_of(needed, width, height);
  const bool in_files = is_kept_in_file(3 * sizeof(float) * map.size());
  const int tile_width = in_files ? kTileWidthInFiles : kTileWidth;
  const int across = (area.width + tile_width - 1) / tile_width,
            down = (area.height + kTileHeight - 1) / kTileHeight;
  oneapi::tbb::parallel_for(0, across * down, [&](int i) {
    const int x = i % across * tile_width, y = i / across * kTileHeight;
    const FlipTile tile{area.left + x, area.top + y, std::min(tile_width, area.width - x),
                        std::min(kTileHeight, area.height - y)};
    const std::size_t columns = std::size_t(tile.width), padded = flip_padded(columns);
    const std::size_t count = padded * std::size_t(tile.height);
    const auto values = std::make_unique_for_overwrite<float[]>(count);
    values_of(tile, {values.get(), count});
    for (int row = 0; row < tile.height; ++row) {
      std::copy_n(values.get() + padded * std::size_t(row), columns,
                  map.begin() + std::ptrdiff_t(tile.top + row) * width + tile.left);
      looked_at_row(columns * sizeof(float));
    }
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

int flip_radius(const MetricInput& input) { return FlipFilters(input.pixels_per_degree).radius(); }

}  // namespace lobelia
