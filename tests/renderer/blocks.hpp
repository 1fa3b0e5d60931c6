// Whether pictures with noise agree: a z-test of blocks of pixels.
#pragma once

#include "base/pictures/image.hpp"
#include "renderer/render.hpp"
#include "tests/test.hpp"

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

/// Renders pictures of new seeds until no block is farther apart than is allowed for so many pictures, and fails after the
/// last number of them. What is rarely drawn makes a mean look certain that is not, so that few pictures decide nothing.
inline void expect_the_same_light(Scene scene, const RenderOptions& a, const RenderOptions& b,
                                  const std::vector<std::pair<int, double>>& pictures_and_allowed =
                                      {{32, 4.5}, {128, 5.0}, {1024, 5.5}},
                                  int most_of_b = 1 << 20) {
  Blocks of_a, of_b;
  std::uint64_t seed = 0;
  double z = 0;
  for (const auto& [pictures, allowed] : pictures_and_allowed) {
    while (of_a.count < pictures) {
      scene.sampler.seed = ++seed;
      of_a.add(render(scene, a).image);
      scene.sampler.seed = ++seed;
      if (of_b.count < std::min(pictures, most_of_b)) of_b.add(render(scene, b).image);
    }
    z = farthest(of_a, of_b);
    if (z < allowed) return;
  }
  FAIL() << z << " sigma";
}

}  // namespace lobelia
