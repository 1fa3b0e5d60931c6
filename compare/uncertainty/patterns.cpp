#include "compare/uncertainty/patterns.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "compare/uncertainty/noise_draws.hpp"

namespace lobelia {
namespace {

using Weights = std::array<double, 3>;

void add_noise(const PictureNoise* noise, std::size_t pixel, const Weights& weights, NoisySum& sum,
               double& shared) {
  if (!noise) return;
  double error = 0;
  for (std::size_t c = 0; c < 3; ++c)
    error += std::abs(weights[c]) * double(noise->cautious.values()[3 * pixel + c]);
  if (noise->shared) {
    shared += error;
    return;
  }
  const double cautious = error * error, own = noise->own_variance(3 * pixel, weights);
  sum.cautious += cautious;
  sum.cautious_squares += cautious * cautious / noise->freedom;
  sum.own += own;
  sum.own_squares += own * own / (noise->freedom + 2);
}

/// The noise of a difference that is as often above as below zero: its own square, on average.
void add_own_size(double difference, NoisySum& sum) {
  const double variance = difference * difference;
  sum.cautious += variance;
  sum.cautious_squares += variance * variance;
  sum.own += variance;
  sum.own_squares += variance * variance;
}

struct Place {
  double x = 0, y = 0;
};

/// The median of the 5 x 5 values around each value, of its channel.
Image medians_around(const Image& image) {
  constexpr int kReach = 2;
  Image medians(image.width(), image.height());
  std::vector<float> around;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        around.clear();
        for (int v = std::max(0, y - kReach); v <= std::min(image.height() - 1, y + kReach); ++v)
          for (int u = std::max(0, x - kReach); u <= std::min(image.width() - 1, x + kReach); ++u)
            around.push_back(image.pixel(u, v)[c]);
        const auto middle = around.begin() + std::ptrdiff_t(around.size() / 2);
        std::ranges::nth_element(around, middle);
        medians.pixel(x, y)[c] = *middle;
      }
  return medians;
}

/// Whether both have fireflies, and as many of them as chance allows: then the difference is as often above as below zero.
bool have_like_fireflies(const NoiseOfPair& noise) {
  if (!noise.a || !noise.b || !noise.a->has_heavy_tails() || !noise.b->has_heavy_tails() ||
      noise.a->shared || noise.b->shared || noise.a->freedom != noise.b->freedom)
    return false;
  const double pixels = double(noise.a->standard_error.pixel_count());
  const double apart = noise.a->fireflies - noise.b->fireflies;
  // Three standard errors of the difference of two shares.
  return apart * apart <= 9 * (noise.a->fireflies + noise.b->fireflies) / pixels;
}

/// The differences of two pictures with fireflies: none is more than kClip times the median around it.
class ClippedDifferences {
 public:
  ClippedDifferences(const Image& a, const std::function<double(std::size_t)>& excess)
      : excess_(excess), limits_(a.width(), a.height()) {
    for (std::size_t i = 0; i < limits_.values().size(); ++i)
      limits_.values()[i] = float(std::abs(excess(i)));
    limits_ = medians_around(limits_);
  }
  double operator()(std::size_t i) const {
    const double most = kClip * double(limits_.values()[i]);
    return std::clamp(excess_(i), -most, most);
  }

 private:
  static constexpr double kClip = 3;
  const std::function<double(std::size_t)>& excess_;
  Image limits_;
};

/// Both pictures' mean without fireflies. It stays as it is if the two are exchanged, so it tells nothing of the sign of
/// a - b.
Image expectation_without_fireflies(const Image& a, const Image& b) {
  Image mean(a.width(), a.height());
  for (std::size_t i = 0; i < mean.values().size(); ++i)
    mean.values()[i] = (a.values()[i] + b.values()[i]) / 2;
  return medians_around(mean);
}

Place centre_of(const Image& image) {
  double all = 0;
  Place sum;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const std::span<const float, 3> rgb = image.pixel(x, y);
      const double light = std::max(0.0, double(rgb[0]) + double(rgb[1]) + double(rgb[2]));
      all += light * light;
      sum.x += light * light * x;
      sum.y += light * light * y;
    }
  return all > 0 ? Place{sum.x / all, sum.y / all} : Place{};
}

}  // namespace

void NoisySum::operator+=(const NoisySum& other) {
  excess += other.excess;
  cautious += other.cautious;
  cautious_squares += other.cautious_squares;
  own += other.own;
  own_squares += other.own_squares;
  shared_a += other.shared_a;
  shared_b += other.shared_b;
}

std::array<NoisySum, kPatterns> sums_of_patterns(const Image& a, const Image& b,
                                                 const NoiseOfPair& noise,
                                                 const std::function<double(std::size_t)>& excess) {
  std::optional<ClippedDifferences> clipped;
  if (have_like_fireflies(noise)) clipped.emplace(a, excess);
  const Image expected =
      clipped ? expectation_without_fireflies(a, b) : common_expectation(a, b, noise);
  std::array<NoisySum, kPatterns> sums;
  const Place centre = centre_of(expected);
  const int width = expected.width(), height = expected.height();
  const auto value = [&](int x, int y, std::size_t c) { return double(expected.pixel(x, y)[c]); };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t pixel = std::size_t(y) * std::size_t(width) + std::size_t(x);
      std::array<Weights, kPatterns> weights;
      for (std::size_t c = 0; c < 3; ++c) {
        const double right =
            (value(std::min(x + 1, width - 1), y, c) - value(std::max(x - 1, 0), y, c)) / 2;
        const double down =
            (value(x, std::min(y + 1, height - 1), c) - value(x, std::max(y - 1, 0), c)) / 2;
        weights[0][c] = value(x, y, c);
        weights[1][c] = right;
        weights[2][c] = down;
        weights[3][c] = (x - centre.x) * right + (y - centre.y) * down;
      }
      std::array<double, 3> apart;
      for (std::size_t c = 0; c < 3; ++c)
        apart[c] = clipped ? (*clipped)(3 * pixel + c) : excess(3 * pixel + c);
      for (std::size_t k = 0; k < weights.size(); ++k) {
        const double weighted =
            weights[k][0] * apart[0] + weights[k][1] * apart[1] + weights[k][2] * apart[2];
        sums[k].excess += weighted;
        if (clipped) {
          add_own_size(weighted, sums[k]);
          continue;
        }
        add_noise(noise.a, pixel, weights[k], sums[k], sums[k].shared_a);
        add_noise(noise.b, pixel, weights[k], sums[k], sums[k].shared_b);
      }
    }
  return sums;
}

}  // namespace lobelia
