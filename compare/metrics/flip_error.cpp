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

}  // namespace

void flip_tile_errors(const DisplayLight& a, const DisplayLight& b, const FlipFilters& filters,
                      const FlipTile& tile, std::span<float> errors) {
  FlipTileRows rows_a(a, filters, tile), rows_b(b, filters, tile);
  const std::size_t padded = flip_padded(std::size_t(tile.width));
  for (int row = 0; row < tile.height; ++row)
    flip_errors(rows_a.next(), rows_b.next(),
                errors.subspan(padded * std::size_t(row), padded).data(), padded);
}

FlipPooled flip_pooled(int width, int height,
                       const std::function<void(const FlipTile&, std::span<float>)>& errors_of) {
  const int across = (width + kTileWidth - 1) / kTileWidth,
            down = (height + kTileHeight - 1) / kTileHeight;
  std::vector<double> tile_sum(std::size_t(across) * std::size_t(down), 0.0), tile_max(tile_sum);
  oneapi::tbb::parallel_for(std::size_t{0}, tile_sum.size(), [&](std::size_t i) {
    const int left = int(i) % across * kTileWidth, top = int(i) / across * kTileHeight;
    const FlipTile tile{left, top, std::min(kTileWidth, width - left),
                        std::min(kTileHeight, height - top)};
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
