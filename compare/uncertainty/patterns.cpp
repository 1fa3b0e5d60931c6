#include "compare/uncertainty/patterns.hpp"

#include <algorithm>
#include <cmath>

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

struct Place {
  double x = 0, y = 0;
};

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
  const Image expected = common_expectation(a, b, noise);
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
      const double apart[] = {excess(3 * pixel), excess(3 * pixel + 1), excess(3 * pixel + 2)};
      for (std::size_t k = 0; k < weights.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) sums[k].excess += weights[k][c] * apart[c];
        add_noise(noise.a, pixel, weights[k], sums[k], sums[k].shared_a);
        add_noise(noise.b, pixel, weights[k], sums[k], sums[k].shared_b);
      }
    }
  return sums;
}

}  // namespace lobelia
