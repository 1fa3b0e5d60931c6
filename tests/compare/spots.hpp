// Pictures of highlights of known figures.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "profile/blob.hpp"

namespace lobelia {

using Radiance = std::function<double(double x, double y)>;

/// A Gaussian or a GGX tail of those half-widths.
struct Spot {
  double x, y, peak, major, minor, tilt = 0;
  bool ggx = false;

  double operator()(double px, double py) const {
    const double c = std::cos(tilt), s = std::sin(tilt), dx = px - x, dy = py - y;
    const double q =
        std::pow((c * dx + s * dy) / major, 2) + std::pow((c * dy - s * dx) / minor, 2);
    return peak * (ggx ? std::pow(1 + (std::numbers::sqrt2 - 1) * q, -2) : std::exp2(-q));
  }
};

inline Image picture(int width, int height, const Radiance& radiance,
                     std::array<double, 3> colour = {1, 1, 1}) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        image.pixel(x, y)[c] = float(colour[c] * radiance(x + 0.5, y + 0.5));
  return image;
}

inline BlobProfiles measured(const Image& image, const BlobOptions& options = {}) {
  return measure_blobs({{"a", &image}}, options);
}
inline BlobFigures first_of(const Image& image, const BlobOptions& options = {}) {
  return measured(image, options).highlights.at(0).blobs.at(0);
}

}  // namespace lobelia
