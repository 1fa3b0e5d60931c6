#include "compare/metrics/flip_error.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace lobelia {
namespace {

// A tile's columns: so few that the rows below each other that a filter needs stay in the first cache, all
// planes of both pictures in the second. Its rows: enough that filtering the ones above and below it again
// costs little, few enough that every processor has some.
constexpr int kTileWidth = 256, kTileHeight = 256;

int tiles_across(int width) { return (width + kTileWidth - 1) / kTileWidth; }
int tiles_down(int height) { return (height + kTileHeight - 1) / kTileHeight; }

/// Calls visit(tile, its index) for all tiles, on many threads.
template <class Visit>
void for_each_tile(int width, int height, Visit visit) {
  const int across = tiles_across(width);
  oneapi::tbb::parallel_for(0, across * tiles_down(height), [&](int i) {
    const int left = i % across * kTileWidth, top = i / across * kTileHeight;
    visit(FlipTile{left, top, std::min(kTileWidth, width - left),
                   std::min(kTileHeight, height - top)},
          std::size_t(i));
  });
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
  const auto width = std::size_t(a.width());
  std::vector<float> map(a.pixel_count());
  for_each_tile(a.width(), a.height(), [&](const FlipTile& tile, std::size_t) {
    const std::size_t padded = flip_padded(std::size_t(tile.width));
    std::vector<float> errors(padded * std::size_t(tile.height));
    flip_tile_errors(a, b, filters, tile, errors);
    for (std::size_t row = 0; row < std::size_t(tile.height); ++row)
      std::copy_n(errors.begin() + std::ptrdiff_t(padded * row), tile.width,
                  map.begin() + std::ptrdiff_t(width * (std::size_t(tile.top) + row) +
                                               std::size_t(tile.left)));
  });
  return map;
}

FlipPooled flip_pooled(int width, int height,
                       const std::function<void(const FlipTile&, std::span<float>)>& errors_of) {
  std::vector<double> tile_sum(std::size_t(tiles_across(width)) * std::size_t(tiles_down(height))),
      tile_max(tile_sum);
  for_each_tile(width, height, [&](const FlipTile& tile, std::size_t i) {
    const std::size_t padded = flip_padded(std::size_t(tile.width));
    std::vector<float> errors(padded * std::size_t(tile.height));
    errors_of(tile, errors);
    double sum = 0;
    float largest = 0;
    for (int row = 0; row < tile.height; ++row) {
      const float* error = errors.data() + padded * std::size_t(row);
      for (int x = 0; x < tile.width; ++x) {
        sum += double(error[x]);
        largest = std::max(largest, error[x]);
      }
    }
    tile_sum[i] = sum;
    tile_max[i] = double(largest);
  });
  // In order of the tiles: the sum must not depend on the number of threads.
  double sum = 0, largest = 0;
  for (const double value : tile_sum) sum += value;
  for (const double value : tile_max) largest = std::max(largest, value);
  return {sum / std::max(double(width) * double(height), 1.0), largest};
}

}  // namespace lobelia
