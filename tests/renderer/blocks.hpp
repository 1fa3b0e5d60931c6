// Whether pictures with noise agree: a z-test of blocks of pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/image.hpp"

namespace lobelia {

/// Means of blocks of pixels over pictures by other seeds, and the variances of the means.
struct Blocks {
  std::vector<double> mean, spread;
  int count = 0;
  void add(const Image& image) {
    constexpr int kSide = 4;
    const int across = image.width() / kSide, down = image.height() / kSide;
    std::vector<double> sums(std::size_t(across * down));
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        for (const float v : image.pixel(x, y))
          sums[std::size_t(y / kSide * across + x / kSide)] += v;
    mean.resize(sums.size()), spread.resize(sums.size());
    ++count;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const double before = sums[i] - mean[i];
      mean[i] += before / count;
      spread[i] += before * (sums[i] - mean[i]);
    }
  }
  double variance(std::size_t i) const { return spread[i] / (count - 1) / count; }
};

/// The difference of a block, in standard errors.
inline double apart(const Blocks& a, const Blocks& b, std::size_t i) {
  const double difference = std::abs(a.mean[i] - b.mean[i]) - 1e-6 * (a.mean[i] + b.mean[i]);
  return std::max(0.0, difference) / std::sqrt(a.variance(i) + b.variance(i) + 1e-300);
}

/// The largest difference of a block, in standard errors.
inline double farthest(const Blocks& a, const Blocks& b) {
  double z = 0;
  for (std::size_t i = 0; i < a.mean.size(); ++i) z = std::max(z, apart(a, b, i));
  return z;
}

}  // namespace lobelia
