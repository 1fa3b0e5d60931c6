// A square of a picture: which samples its pixels take, and what they come to.
#pragma once

#include <span>
#include <vector>

#include "core/image.hpp"
#include "renderer/waves/wave_renderer.hpp"

namespace lobelia {

struct Tile {
  int x = 0, y = 0, width = 0, height = 0;
};

/// How far the two halves of the samples are apart, summed over pixels and channels.
struct Spread {
  double difference_squared = 0, value_squared = 0;
  Spread& operator+=(const Spread& other) {
    difference_squared += other.difference_squared;
    value_squared += other.value_squared;
    return *this;
  }
  /// As RenderResult::error: half the difference of two halves is the error of their mean.
  double error() const;
};

/// The sum of a pixel's samples.
struct PixelSum {
  struct Part {
    Rgb radiance;
    int count = 0;
  };
  Part positive, negative;  ///< of the filter
  void add(const SampleResult& sample);
  /// negative_weight: of the filter. While only positive ones were drawn, their mean.
  Rgb mean(double negative_weight) const;
};

/// A whole picture of sums.
class Frame {
 public:
  /// negative_weight: of the filter.
  Frame(int width, int height, double negative_weight);
  PixelSum& sum(int x, int y) { return sums_[index(x, y)]; }
  /// Keeps what the first `done` samples came to, then says how far the next ones are from it.
  void keep(const Tile& tile, int done);
  /// After samples done..next - 1 were added to the `done` that were kept; done > 0.
  double error(int done, int next) const;
  void resolve(Image& image) const;

 private:
  std::size_t index(int x, int y) const {
    return std::size_t(y) * std::size_t(width_) + std::size_t(x);
  }
  int width_, height_;
  double negative_weight_;
  std::vector<PixelSum> sums_;
  std::vector<Rgb> kept_;  ///< means
};

class TileRenderer {
 public:
  TileRenderer(const Scene& scene, const Plan& plan, const WaveRenderer& renderer);

  /// All samples; row y of the picture goes to `rgb` + 3 * width * (y - first_row).
  Spread render(const Tile& tile, int samples, float* rgb, int first_row,
                Workspace& workspace) const;
  /// Samples first..last - 1 of every pixel.
  void add(const Tile& tile, int first, int last, Frame& frame, Workspace& workspace) const;

  /// Whether more samples give another picture, apart from antialiasing.
  bool is_random() const { return random_; }
  /// The fewest that show the whole filter: one of each part.
  int least_samples() const { return negative_weight_ > 0 ? 2 : 1; }
  double negative_weight() const { return negative_weight_; }

 private:
  template <class Take>
  void take(std::span<const PixelSample> pixels, int first, int last, Workspace& workspace,
            const Take& take_result) const;
  Spread render_everywhere(const Tile& tile, int samples, float* rgb, int first_row,
                           Workspace& workspace) const;
  void render_where_needed(const Tile& tile, int samples, float* rgb, int first_row,
                           Workspace& workspace) const;

  const Scene& scene_;
  const Plan& plan_;
  const WaveRenderer& renderer_;
  bool random_;
  double negative_weight_;  ///< of the filter
  double too_little_;       ///< to be seen: a difference of radiance
};

}  // namespace lobelia
