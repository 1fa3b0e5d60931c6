// Renders a square of a picture: chooses the samples of its pixels, and averages them.
#pragma once

#include "base/pictures/image.hpp"
#include "renderer/waves/waves.hpp"

namespace lobelia {

using waves::Workspace;

struct Tile {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The difference between the two halves of the samples, summed over pixels and channels.
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
  /// `negative_weight` is the filter's. The mean of the positive samples while there are no others.
  Rgb mean(double negative_weight) const;
};

/// The sums of a whole picture.
class Frame {
 public:
  /// `negative_weight` is the filter's.
  Frame(int width, int height, double negative_weight);
  PixelSum& sum(int x, int y) { return sums_[index(x, y)]; }
  /// Keeps the means of the first `done` samples for error().
  void keep(const Tile& tile, int done);
  /// RenderResult::error, after samples done..next - 1 were added to the `done` kept ones; done > 0.
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
  /// Both must outlive it.
  TileRenderer(const Scene& scene, const Plan& plan);

  /// All samples; row y of the picture goes to `rgb` + 3 * width * (y - first_row).
  Spread render(const Tile& tile, int samples, float* rgb, int first_row,
                Workspace& workspace) const;
  /// Samples first..last - 1 of every pixel.
  void add(const Tile& tile, int first, int last, Frame& frame, Workspace& workspace) const;

  /// Whether more samples give another picture, apart from antialiasing.
  bool is_random() const { return random_; }
  /// One sample for each part of the filter.
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

  float* pixel(int x, int y, float* rgb, int first_row) const;

  waves::PreparedScene prepared_;
  bool random_;
  double negative_weight_;  ///< of the filter
  double invisible_;        ///< a difference of radiance that is too small to see
};

}  // namespace lobelia
