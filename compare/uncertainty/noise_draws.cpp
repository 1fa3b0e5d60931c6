#include "compare/uncertainty/noise_draws.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace lobelia {
namespace {

/// Draws from the deviations of replicates.
class ReplicateDraw {
 public:
  ReplicateDraw(const PictureNoise& noise, std::uint64_t stream, bool whole_picture)
      : noise_(noise),
        stream_(stream),
        whole_picture_(whole_picture),
        width_(noise.standard_error.width()),
        height_(noise.standard_error.height()),
        count_(noise.deviations.size() + 1),
        scale_(1 / std::sqrt(double(count_) * double(count_) - double(count_ % 2))) {}

  void add_to_row(int y, std::span<float> row) const {
    std::vector<double> weights(count_ - 1);
    if (whole_picture_) choose_half(mix(stream_), weights);
    for (int x = 0; x < width_; ++x) {
      const std::size_t own = at(x, y);
      if (!is_noisy(own)) continue;
      std::uint64_t bits = mix(mix(stream_) ^ own);
      std::size_t from = own;
      if (!whole_picture_) {
        if (noise_.freedom < kFewFreedom) from = neighbour(x, y, bits);
        choose_half(mix(bits), weights);
      }
      double more[3] = {};
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t r = 0; r < weights.size(); ++r)
          more[c] += weights[r] * double(noise_.deviations[r].values()[3 * from + c]);
      for (std::size_t c = 0; c < 3; ++c) row[3 * std::size_t(x) + c] += float(scale_ * more[c]);
    }
  }

 private:
  std::size_t at(int x, int y) const {
    return std::size_t(y) * std::size_t(width_) + std::size_t(x);
  }

  bool is_noisy(std::size_t pixel) const {
    return std::ranges::any_of(noise_.deviations, [&](const Image& deviation) {
      const float* const values = deviation.values().data() + 3 * pixel;
      return values[0] != 0 || values[1] != 0 || values[2] != 0;
    });
  }

  /// One of the noisy pixels around, itself among them.
  std::size_t neighbour(int x, int y, std::uint64_t bits) const {
    std::array<std::size_t, 9> noisy{};
    std::size_t count = 0;
    for (int j = std::max(0, y - 1); j <= std::min(height_ - 1, y + 1); ++j)
      for (int i = std::max(0, x - 1); i <= std::min(width_ - 1, x + 1); ++i)
        if (is_noisy(at(i, j))) noisy[count++] = at(i, j);
    return noisy[(bits >> 32) % count];
  }

  /// 1 for one half of the replicates and -1 for the other. The last one's deviation is less the sum of the others, so its
  /// sign is taken off theirs.
  void choose_half(std::uint64_t bits, std::span<double> weights) const {
    std::size_t positive = count_ / 2;
    if (count_ % 2 == 1) positive += bits & 1;
    for (std::size_t r = 0; r < weights.size(); ++r) {
      bits = mix(bits);
      const std::size_t left = count_ - r;
      const bool is_positive = (bits >> 32) % left < positive;
      positive -= is_positive;
      weights[r] = is_positive ? 1 : -1;
    }
    const double last = positive > 0 ? 1 : -1;
    for (double& weight : weights) weight -= last;
  }

  const PictureNoise& noise_;
  std::uint64_t stream_;
  bool whole_picture_;
  int width_, height_;
  std::size_t count_;
  double scale_;  ///< of the sum of half the replicates less the other half
};

void add_normal(const PictureNoise& noise, std::uint64_t stream, Together together,
                std::size_t first, std::span<float> values) {
  const double one = together == Together::kPicture ? gaussian(stream, ~std::uint64_t{0}) : 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = double(noise.standard_error.values()[first + i]);
    if (!(error > 0)) continue;
    const double normal = together == Together::kPicture    ? one
                          : together == Together::kChannels ? gaussian(stream, (first + i) / 3)
                                                            : gaussian(stream, first + i);
    values[i] += float(error * normal);
  }
}

/// The variance of a value, on average right.
double variance_of(const PictureNoise* noise, std::size_t i) {
  const double error = noise ? double(noise->standard_error.values()[i]) : 0;
  return error * error;
}

/// The picture averaged over 5 x 5 pixels where its values vary no more than by the noise.
Image smoothed(const Image& image, const NoiseOfPair& noise) {
  constexpr int kReach = 2;
  Image result = image;
  const int width = image.width(), height = image.height();
  oneapi::tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t own = 3 * (std::size_t(y) * std::size_t(width) + std::size_t(x)) + c;
        const double a = variance_of(noise.a, own), b = variance_of(noise.b, own);
        if (!(a > 0 && b > 0)) continue;
        double sum = 0, squares = 0;
        int count = 0;
        for (int j = std::max(0, y - kReach); j <= std::min(height - 1, y + kReach); ++j)
          for (int i = std::max(0, x - kReach); i <= std::min(width - 1, x + kReach); ++i) {
            const double value = double(image.pixel(i, j)[c]);
            sum += value;
            squares += value * value;
            ++count;
          }
        const double mean = sum / count, spread = std::max(0.0, squares / count - mean * mean);
        const double own_share = spread > 0 ? std::max(0.0, 1 - a * b / (a + b) / spread) : 0;
        result.values()[own] = float(mean + own_share * (double(image.values()[own]) - mean));
      }
  });
  return result;
}

}  // namespace

std::vector<Together> what_may_err_together(const NoiseOfPair& noise) {
  bool any_errors = false, any_shared = false;
  for (const PictureNoise* one : {noise.a, noise.b}) {
    any_errors = any_errors || (one && one->deviations.empty());
    any_shared = any_shared || (one && one->shared);
  }
  std::vector<Together> list{Together::kChannels};
  if (any_errors) list.push_back(Together::kNothing);
  if (any_shared) list.push_back(Together::kPicture);
  return list;
}

Image with_noise(const Image& image, const PictureNoise* noise, std::uint64_t stream,
                 Together together) {
  Image result = image;
  if (!noise) return result;
  if (together == Together::kPicture && !noise->shared) together = Together::kChannels;
  const auto row_of = [&](int y) {
    const std::size_t values = 3 * std::size_t(image.width());
    return std::pair(values * std::size_t(y),
                     result.values().subspan(values * std::size_t(y), values));
  };
  if (!noise->deviations.empty()) {
    const ReplicateDraw draw(*noise, stream, together == Together::kPicture);
    oneapi::tbb::parallel_for(0, image.height(),
                              [&](int y) { draw.add_to_row(y, row_of(y).second); });
    return result;
  }
  oneapi::tbb::parallel_for(0, image.height(), [&](int y) {
    const auto [first, values] = row_of(y);
    add_normal(*noise, stream, together, first, values);
  });
  return result;
}

Image common_expectation(const Image& a, const Image& b, const NoiseOfPair& noise) {
  Image mean = b;
  for (std::size_t i = 0; i < mean.values().size(); ++i) {
    const double of_a = variance_of(noise.a, i), of_b = variance_of(noise.b, i);
    if (!(of_b > 0)) continue;  // b is exact
    const double value_a = double(a.values()[i]), value_b = double(b.values()[i]);
    mean.values()[i] = float(value_b + (value_a - value_b) * of_b / (of_a + of_b));
  }
  return smoothed(mean, noise);
}

}  // namespace lobelia
