#include "renderer/tile.hpp"

#include "renderer/peak_bound.hpp"

namespace lobelia {
namespace {

double brightness(Rgb c) { return (c.r + c.g + c.b) / 3; }

void write(Rgb mean, float* to) {
  to[0] = float(mean.r);
  to[1] = float(mean.g);
  to[2] = float(mean.b);
}

double squared(Rgb a) { return a.r * a.r + a.g * a.g + a.b * a.b; }
Rgb difference(Rgb a, Rgb b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
PixelSum::Part difference(const PixelSum::Part& a, const PixelSum::Part& b) {
  return {difference(a.radiance, b.radiance), a.count - b.count};
}

/// The brightness and the surface that the first samples of some pixels met.
struct Seen {
  static constexpr int kNothingYet = -2, kSeveral = -3;
  double least = 1e300, most = -1e300;
  int surface = kNothingYet;
  void add(const Seen& other) {
    least = std::min(least, other.least);
    most = std::max(most, other.most);
    if (surface == kNothingYet)
      surface = other.surface;
    else if (surface != other.surface)
      surface = kSeveral;
  }
};

/// For each pixel of a field, all that was seen in the square of `reach` pixels around it.
std::vector<Seen> look_around(const std::vector<Seen>& field, int width, int height, int reach) {
  const auto along = [&](const std::vector<Seen>& from, int stride, int size) {
    std::vector<Seen> to(from.size());
    for (int i = 0; i < width * height; ++i) {
      const int at = i / stride % size;
      for (int d = -std::min(reach, at); d <= std::min(reach, size - 1 - at); ++d)
        to[std::size_t(i)].add(from[std::size_t(i + d * stride)]);
    }
    return to;
  };
  return along(along(field, 1, width), width, height);
}

std::vector<PixelSample> pixels_of(const Tile& tile) {
  std::vector<PixelSample> pixels;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) pixels.push_back({x, y, 0});
  return pixels;
}

}  // namespace

double Spread::error() const {
  return value_squared > 0 ? 0.5 * std::sqrt(difference_squared / value_squared) : 0;
}

void PixelSum::add(const SampleResult& sample) {
  Part& part = sample.negative ? negative : positive;
  part.radiance = part.radiance + sample.radiance;
  ++part.count;
}

Rgb PixelSum::mean(double negative_weight) const {
  if (negative.count == 0) return 1.0 / positive.count * positive.radiance;
  return difference((1 + negative_weight) / positive.count * positive.radiance,
                    negative_weight / negative.count * negative.radiance);
}

Frame::Frame(int width, int height, double negative_weight)
    : width_(width),
      height_(height),
      negative_weight_(negative_weight),
      sums_(std::size_t(width) * std::size_t(height)),
      kept_(sums_.size()) {}

void Frame::keep(const Tile& tile, int done) {
  if (done == 0) return;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x)
      kept_[index(x, y)] = sums_[index(x, y)].mean(negative_weight_);
}

double Frame::error(int done, int next) const {
  Spread spread;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const Rgb mean = sums_[i].mean(negative_weight_);
    // With `more` samples added to `done`, mean - kept has more / done times the variance of the mean. `apart` is
    // scaled so that half of it has that variance.
    const double more = next - done;
    const Rgb apart = 2 * std::sqrt(done / more) * difference(mean, kept_[i]);
    spread += {squared(apart), squared(mean)};
  }
  return spread.error();
}

void Frame::resolve(Image& image) const {
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      write(sums_[index(x, y)].mean(negative_weight_), image.pixel(x, y).data());
}

TileRenderer::TileRenderer(const Scene& scene, const Plan& plan)
    : prepared_(scene, plan),
      random_(prepared_.any_sized || plan.depth.glossy > 0 || scene.camera.aperture_radius > 0),
      negative_weight_(prepared_.filter.negative_weight()),
      invisible_(effects::Antialiasing::kBlack * peak_bound(scene, scene.lights)) {}

float* TileRenderer::pixel(int x, int y, float* rgb, int first_row) const {
  return rgb + 3 * (std::size_t(y - first_row) * std::size_t(prepared_.scene.film.width) +
                    std::size_t(x));
}

/// Calls take_result(pixel, sample, result) for samples first..last - 1 of all pixels, rendered a chunk at a time.
template <class Take>
void TileRenderer::take(std::span<const PixelSample> pixels, int first, int last,
                        Workspace& workspace, const Take& take_result) const {
  std::array<PixelSample, kChunk> samples;
  std::array<SampleResult, kChunk> results;
  const std::size_t each = std::size_t(last - first), all = pixels.size() * each;
  for (std::size_t begin = 0; begin < all; begin += kChunk) {
    const std::size_t count = std::min(kChunk, all - begin);
    for (std::size_t i = 0; i < count; ++i) {
      // Keeps a pixel's samples together: most of them meet the same surface.
      samples[i] = pixels[(begin + i) / each];
      samples[i].index = std::uint32_t(std::size_t(first) + (begin + i) % each);
    }
    waves::render(prepared_, {samples.data(), count}, {results.data(), count}, workspace);
    for (std::size_t i = 0; i < count; ++i)
      take_result((begin + i) / each, int(samples[i].index), results[i]);
  }
}

Spread TileRenderer::render(const Tile& tile, int samples, float* rgb, int first_row,
                            Workspace& workspace) const {
  if (prepared_.plan.first_samples >= samples)
    return render_everywhere(tile, samples, rgb, first_row, workspace);
  render_where_needed(tile, samples, rgb, first_row, workspace);
  return {};
}

Spread TileRenderer::render_everywhere(const Tile& tile, int samples, float* rgb, int first_row,
                                       Workspace& workspace) const {
  const std::vector<PixelSample> pixels = pixels_of(tile);
  std::vector<PixelSum> sums(pixels.size()), halves(pixels.size());
  take(pixels, 0, samples, workspace,
       [&](std::size_t pixel, int sample, const SampleResult& result) {
         sums[pixel].add(result);
         if (sample < samples / 2) halves[pixel].add(result);
       });
  Spread spread;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Rgb mean = sums[i].mean(negative_weight_);
    write(mean, pixel(pixels[i].x, pixels[i].y, rgb, first_row));
    if (samples <= least_samples()) continue;
    const PixelSum& half = halves[i];
    const PixelSum other{difference(sums[i].positive, half.positive),
                         difference(sums[i].negative, half.negative)};
    spread += {squared(difference(half.mean(negative_weight_), other.mean(negative_weight_))),
               squared(mean)};
  }
  return spread;
}

/// Takes a few samples of every pixel in the tile and around it. Takes the rest only where these show more than an
/// even surface within the filter's reach.
void TileRenderer::render_where_needed(const Tile& tile, int samples, float* rgb, int first_row,
                                       Workspace& workspace) const {
  const Film& film = prepared_.scene.film;
  const PixelRange columns = looked_at({tile.x, tile.x + tile.width}, film.width, film.filter);
  const PixelRange rows = looked_at({tile.y, tile.y + tile.height}, film.height, film.filter);
  const int width = columns.end - columns.begin, height = rows.end - rows.begin;
  const std::vector<PixelSample> pixels = pixels_of({columns.begin, rows.begin, width, height});
  std::vector<PixelSum> sums(pixels.size());
  std::vector<Seen> seen(pixels.size());
  const int first = prepared_.plan.first_samples;
  take(pixels, 0, first, workspace, [&](std::size_t pixel, int, const SampleResult& result) {
    sums[pixel].add(result);
    const double value = brightness(result.radiance);
    seen[pixel].add({value, value, result.surface});
  });
  const std::vector<Seen> around = look_around(seen, width, height, reach_of(film.filter));
  std::vector<PixelSample> needing;
  std::vector<std::size_t> place;
  const auto index = [&](int x, int y) {
    return std::size_t(y - rows.begin) * std::size_t(width) + std::size_t(x - columns.begin);
  };
  const std::vector<PixelSample> own = pixels_of(tile);
  for (const PixelSample& p : own) {
    const std::size_t i = index(p.x, p.y);
    const double mean = std::abs(brightness(sums[i].mean(negative_weight_)));
    if (around[i].surface == Seen::kSeveral ||
        around[i].most - around[i].least >
            std::max(effects::Antialiasing::kSame * mean, invisible_)) {
      needing.push_back(p);
      place.push_back(i);
    }
  }
  take(needing, first, samples, workspace,
       [&](std::size_t pixel, int, const SampleResult& result) { sums[place[pixel]].add(result); });
  for (const PixelSample& p : own)
    write(sums[index(p.x, p.y)].mean(negative_weight_), pixel(p.x, p.y, rgb, first_row));
}

void TileRenderer::add(const Tile& tile, int first, int last, Frame& frame,
                       Workspace& workspace) const {
  frame.keep(tile, first);
  const std::vector<PixelSample> pixels = pixels_of(tile);
  take(pixels, first, last, workspace, [&](std::size_t pixel, int, const SampleResult& result) {
    frame.sum(pixels[pixel].x, pixels[pixel].y).add(result);
  });
}

}  // namespace lobelia
