#include "profile/noise.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "profile/require_same_size.hpp"

namespace lobelia {
namespace {

constexpr int kSquare = 5, kLineReach = 8, kLine = 2 * kLineReach + 1;
/// From this side on, every pixel is a corner of a whole square.
constexpr int kLeastSide = 2 * (kSquare - 1);

/// Squares of standard errors, and sums of them around a pixel.
class Variances {
 public:
  explicit Variances(const Image& error) : width_(error.width()), height_(error.height()) {
    values_.reserve(error.values().size());
    for (const float value : error.values()) values_.push_back(double(value) * double(value));
  }

  double at(int x, int y, int channel) const {
    return values_[3 * (std::size_t(y) * std::size_t(width_) + std::size_t(x)) +
                   std::size_t(channel)];
  }

  /// The largest of the means over lines and squares around a pixel; 0 if none lies in the picture.
  double pooled(int x, int y, int channel) const {
    constexpr std::pair<int, int> kDirections[] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};
    constexpr std::pair<int, int> kCorners[] = {{1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
    double largest = 0;
    for (const auto& [dx, dy] : kDirections) {
      if (!inside(x - kLineReach * dx, y - kLineReach * dy) ||
          !inside(x + kLineReach * dx, y + kLineReach * dy))
        continue;
      double sum = 0;
      for (int k = -kLineReach; k <= kLineReach; ++k) sum += at(x + k * dx, y + k * dy, channel);
      largest = std::max(largest, sum / kLine);
    }
    for (const auto& [dx, dy] : kCorners) {
      if (!inside(x + (kSquare - 1) * dx, y + (kSquare - 1) * dy)) continue;
      double sum = 0;
      for (int j = 0; j < kSquare; ++j)
        for (int i = 0; i < kSquare; ++i) sum += at(x + i * dx, y + j * dy, channel);
      largest = std::max(largest, sum / (kSquare * kSquare));
    }
    return largest;
  }

  double largest_around(int x, int y, int channel) const {
    double largest = 0;
    for (int j = std::max(0, y - 1); j <= std::min(height_ - 1, y + 1); ++j)
      for (int i = std::max(0, x - 1); i <= std::min(width_ - 1, x + 1); ++i)
        largest = std::max(largest, at(i, j, channel));
    return largest;
  }

  /// The mean over the noisy pixels in the square around a pixel; 0 if the pixel itself has no noise. So the sum over
  /// the picture stays, and pixels beside the noise get none of it.
  double mean_around(int x, int y, int channel) const {
    constexpr int kReach = kSquare / 2;
    if (at(x, y, channel) == 0) return 0;
    double sum = 0;
    int count = 0;
    for (int j = std::max(0, y - kReach); j <= std::min(height_ - 1, y + kReach); ++j)
      for (int i = std::max(0, x - kReach); i <= std::min(width_ - 1, x + kReach); ++i) {
        sum += at(i, j, channel);
        count += at(i, j, channel) > 0;
      }
    return sum / count;
  }

 private:
  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  int width_, height_;
  std::vector<double> values_;
};

/// A picture of the roots of variance(x, y, channel).
template <class Variance>
Image roots(int width, int height, Variance variance) {
  Image result(width, height);
  oneapi::tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel)
        result.pixel(x, y)[std::size_t(channel)] = float(std::sqrt(variance(x, y, channel)));
  });
  return result;
}

/// The share of pixels that err far more than all around them.
double share_of_fireflies(const Variances& variances, int width, int height) {
  constexpr double kOfVariance = kFireflyFactor * kFireflyFactor;
  const auto size = [&](int x, int y) {
    return variances.at(x, y, 0) + variances.at(x, y, 1) + variances.at(x, y, 2);
  };
  const auto is_firefly = [&](int x, int y) {
    const double own = size(x, y);
    if (own == 0) return false;
    double around = 0;
    for (int j = std::max(0, y - 1); j <= std::min(height - 1, y + 1); ++j)
      for (int i = std::max(0, x - 1); i <= std::min(width - 1, x + 1); ++i)
        if (i != x || j != y) around = std::max(around, size(i, j));
    return around > 0 && own > kOfVariance * around;
  };
  std::vector<std::int64_t> counts(std::size_t(height), 0);
  oneapi::tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) counts[std::size_t(y)] += is_firefly(x, y);
  });
  std::int64_t count = 0;
  for (const std::int64_t one : counts) count += one;
  return double(count) / (double(width) * height);
}

PictureNoise noise_of(const Image& error, double freedom, bool shared) {
  const Variances variances(error);
  const int width = error.width(), height = error.height();
  PictureNoise noise;
  noise.freedom = freedom;
  noise.shared = shared;
  noise.standard_error = roots(width, height, [&](int x, int y, int c) {
    if (freedom < kFewFreedom) return variances.mean_around(x, y, c);
    const double unbiased = 1 + 1 / (4 * freedom);
    return unbiased * unbiased * variances.at(x, y, c);
  });
  const Variances pooled(
      roots(width, height, [&](int x, int y, int c) { return variances.pooled(x, y, c); }));
  noise.cautious = roots(width, height, [&](int x, int y, int c) {
    return std::max(variances.at(x, y, c), pooled.largest_around(x, y, c));
  });
  const bool has_windows = std::min(width, height) >= kLeastSide;
  noise.fireflies = share_of_fireflies(variances, width, height);
  // The variances of a window are no estimate of one variance if a few pixels have nearly all of them.
  const bool pools = has_windows && !shared && !noise.has_heavy_tails();
  noise.pooled_freedom = pools ? std::max(freedom, double(kLine)) : freedom;
  return noise;
}

/// Throws Error(kInput) for a picture that is no error or no variance.
void require_errors(const Image& image, std::string_view what) {
  if (image.pixel_count() == 0)
    throw Error(ExitCode::kInput, "the picture of {}s has no pixels", what);
  const auto values = image.values();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] >= 0) || !std::isfinite(values[i]))
      throw Error(
          ExitCode::kInput, "a {} is {} at pixel ({}, {}); it must be finite and not negative",
          what, values[i], i / 3 % std::size_t(image.width()), i / 3 / std::size_t(image.width()));
}

}  // namespace

PictureNoise noise_of_standard_errors(const Image& standard_error, double freedom, bool shared) {
  if (!(freedom >= 1))
    throw Error(ExitCode::kUsage, "{} degrees of freedom; there must be at least 1", freedom);
  require_errors(standard_error, "standard error");
  return noise_of(standard_error, freedom, shared);
}

PictureNoise noise_of_variances(const Image& variance, double samples, double freedom,
                                bool shared) {
  if (!(samples >= 1))
    throw Error(ExitCode::kUsage, "{:g} samples a pixel; there must be at least 1", samples);
  require_errors(variance, "variance");
  Image error = variance;
  for (float& value : error.values()) value = float(std::sqrt(double(value) / samples));
  return noise_of_standard_errors(error, samples >= 2 ? samples - 1 : freedom, shared);
}

NoisyPicture mean_of_replicates(std::span<const Image> replicates, bool shared) {
  if (replicates.size() < 2)
    throw Error(ExitCode::kInput, "noise cannot be told from fewer than two pictures");
  const Image& first = replicates.front();
  for (const Image& image : replicates) require_same_size(image, first);
  for (const Image& image : replicates.subspan(1))
    if (std::ranges::equal(image.values(), first.values()))
      throw Error(ExitCode::kInput,
                  "this picture is the same in every value; render it with another seed");
  const double n = double(replicates.size());
  Image mean(first.width(), first.height()), error(first.width(), first.height());
  for (std::size_t i = 0; i < mean.values().size(); ++i) {
    double sum = 0, squares = 0;
    for (const Image& image : replicates) sum += double(image.values()[i]);
    mean.values()[i] = float(sum / n);
    for (const Image& image : replicates) {
      const double apart = double(image.values()[i]) - sum / n;
      squares += apart * apart;
    }
    // A mean that is not finite needs no error.
    error.values()[i] = std::isfinite(squares) ? float(std::sqrt(squares / (n * (n - 1)))) : 0;
  }
  PictureNoise noise = noise_of(error, n - 1, shared);
  for (const Image& image : replicates.first(replicates.size() - 1)) {
    Image& deviation = noise.deviations.emplace_back(image);
    for (std::size_t i = 0; i < mean.values().size(); ++i)
      deviation.values()[i] -= mean.values()[i];
  }
  return {std::move(mean), std::move(noise)};
}

std::vector<Image*> PictureNoise::images() {
  std::vector<Image*> all{&standard_error, &cautious};
  for (Image& deviation : deviations) all.push_back(&deviation);
  return all;
}

double PictureNoise::own_variance(std::size_t value) const {
  constexpr double kOne[] = {1};
  return own_variance(value, kOne);
}

double PictureNoise::own_variance(std::size_t first, std::span<const double> weights) const {
  if (deviations.empty()) {
    double error = 0;
    for (std::size_t i = 0; i < weights.size(); ++i)
      error += std::abs(weights[i]) * double(standard_error.values()[first + i]);
    return error * error;
  }
  double last = 0, squares = 0;
  for (const Image& deviation : deviations) {
    double apart = 0;
    for (std::size_t i = 0; i < weights.size(); ++i)
      apart += weights[i] * double(deviation.values()[first + i]);
    last -= apart;
    squares += apart * apart;
  }
  return (squares + last * last) / (freedom * (freedom + 1));
}

}  // namespace lobelia
