#include "renderer/tile.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/peak_bound.hpp"

namespace lobelia {
namespace {

/// A pixel whose first samples, and its neighbours', are no more than this share of their mean apart has
/// nothing in it that more samples would show: half a step of an 8-bit display at mid-grey.
constexpr double kSame = 1.0 / 256;
/// What is less than this share of the brightest highlight is black.
constexpr double kBlack = 1e-5;

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
    // With `more` samples added to `done`, mean - kept has more / done times the variance of the mean;
    // half of `apart` has that of the mean.
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

TileRenderer::TileRenderer(const Scene& scene, const Plan& plan, const WaveRenderer& renderer)
    : scene_(scene),
      plan_(plan),
      renderer_(renderer),
      random_(std::any_of(scene.lights.begin(), scene.lights.end(),
                          [](const Light& l) { return !is_delta(l); }) ||
              plan.depth.glossy > 0 || scene.camera.aperture_radius > 0),
      negative_weight_(renderer.filter().negative_weight()),
      too_little_(kBlack * peak_bound(scene, scene.lights)) {}

/// Samples first..last - 1 of all pixels, a chunk at a time; take_result(pixel, sample, result).
template <class Take>
void TileRenderer::take(std::span<const PixelSample> pixels, int first, int last,
                        WaveRenderer::Workspace& workspace, const Take& take_result) const {
  std::array<PixelSample, kChunk> samples;
  std::array<SampleResult, kChunk> results;
  const std::size_t each = std::size_t(last - first), all = pixels.size() * each;
  for (std::size_t begin = 0; begin < all; begin += kChunk) {
    const std::size_t count = std::min(kChunk, all - begin);
    for (std::size_t i = 0; i < count; ++i) {
      // A pixel's samples side by side: most of them meet the same surface.
      samples[i] = pixels[(begin + i) / each];
      samples[i].index = std::uint32_t(std::size_t(first) + (begin + i) % each);
    }
    renderer_.render({samples.data(), count}, {results.data(), count}, workspace);
    for (std::size_t i = 0; i < count; ++i)
      take_result((begin + i) / each, int(samples[i].index), results[i]);
  }
}

Spread TileRenderer::render(const Tile& tile, int samples, float* rgb, int first_row,
                            WaveRenderer::Workspace& workspace) const {
  if (plan_.first_samples >= samples)
    return render_everywhere(tile, samples, rgb, first_row, workspace);
  render_where_needed(tile, samples, rgb, first_row, workspace);
  return {};
}

Spread TileRenderer::render_everywhere(const Tile& tile, int samples, float* rgb, int first_row,
                                       WaveRenderer::Workspace& workspace) const {
  std::vector<PixelSample> pixels;
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) pixels.push_back({tile.x + x, tile.y + y, 0});
  std::vector<PixelSum> sums(pixels.size()), halves(pixels.size());
  take(pixels, 0, samples, workspace,
       [&](std::size_t pixel, int sample, const SampleResult& result) {
         sums[pixel].add(result);
         if (sample < samples / 2) halves[pixel].add(result);
       });
  Spread spread;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Rgb mean = sums[i].mean(negative_weight_);
    write(mean, rgb + 3 * (std::size_t(pixels[i].y - first_row) * std::size_t(scene_.film.width) +
                           std::size_t(pixels[i].x)));
    if (samples <= least_samples()) continue;
    const PixelSum& half = halves[i];
    const PixelSum other{difference(sums[i].positive, half.positive),
                         difference(sums[i].negative, half.negative)};
    spread += {squared(difference(half.mean(negative_weight_), other.mean(negative_weight_))),
               squared(mean)};
  }
  return spread;
}

/// A few samples of every pixel, and of those around the tile; then the rest where a pixel or one of its
/// neighbours shows more than an even surface.
void TileRenderer::render_where_needed(const Tile& tile, int samples, float* rgb, int first_row,
                                       WaveRenderer::Workspace& workspace) const {
  const int x0 = std::max(0, tile.x - 1), x1 = std::min(scene_.film.width, tile.x + tile.width + 1);
  const int y0 = std::max(0, tile.y - 1);
  const int y1 = std::min(scene_.film.height, tile.y + tile.height + 1);
  const int width = x1 - x0;
  struct Seen {
    PixelSum sum;
    double least = 1e300, most = -1e300;
    int surface = -2;  ///< -3 where samples met several
  };
  std::vector<PixelSample> pixels;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) pixels.push_back({x, y, 0});
  std::vector<Seen> seen(pixels.size());
  take(pixels, 0, plan_.first_samples, workspace,
       [&](std::size_t pixel, int, const SampleResult& result) {
         Seen& s = seen[pixel];
         s.sum.add(result);
         s.least = std::min(s.least, brightness(result.radiance));
         s.most = std::max(s.most, brightness(result.radiance));
         s.surface = s.surface == -2 || s.surface == result.surface ? result.surface : -3;
       });
  std::vector<PixelSample> needing;
  std::vector<std::size_t> place;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      double least = 1e300, most = -1e300;
      const std::size_t here = std::size_t(y - y0) * std::size_t(width) + std::size_t(x - x0);
      const Seen& own = seen[here];
      bool edge = own.surface == -3;
      for (int v = std::max(y0, y - 1); v < std::min(y1, y + 2); ++v)
        for (int u = std::max(x0, x - 1); u < std::min(x1, x + 2); ++u) {
          const Seen& s = seen[std::size_t(v - y0) * std::size_t(width) + std::size_t(u - x0)];
          least = std::min(least, s.least);
          most = std::max(most, s.most);
          edge |= s.surface != own.surface;
        }
      const double mean = brightness(own.sum.mean(negative_weight_));
      if (edge || most - least > std::max(kSame * 8 * std::abs(mean), too_little_)) {
        needing.push_back({x, y, 0});
        place.push_back(here);
      }
    }
  take(needing, plan_.first_samples, samples, workspace,
       [&](std::size_t pixel, int, const SampleResult& result) {
         seen[place[pixel]].sum.add(result);
       });
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const std::size_t here = std::size_t(y - y0) * std::size_t(width) + std::size_t(x - x0);
      write(
          seen[here].sum.mean(negative_weight_),
          rgb + 3 * (std::size_t(y - first_row) * std::size_t(scene_.film.width) + std::size_t(x)));
    }
}

void TileRenderer::add(const Tile& tile, int first, int last, Frame& frame,
                       WaveRenderer::Workspace& workspace) const {
  frame.keep(tile, first);
  std::vector<PixelSample> pixels;
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) pixels.push_back({tile.x + x, tile.y + y, 0});
  take(pixels, first, last, workspace, [&](std::size_t pixel, int, const SampleResult& result) {
    frame.sum(pixels[pixel].x, pixels[pixel].y).add(result);
  });
}

}  // namespace lobelia
