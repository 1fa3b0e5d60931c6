// Small pictures for the tests, the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>

#include "base/pictures/image.hpp"
#include "compare/metrics/metric.hpp"
#include "compare/uncertainty/z_test.hpp"

namespace lobelia::fixtures {

inline Image flat(int width, int height, float r, float g, float b) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto pixel = image.pixel(x, y);
      pixel[0] = r, pixel[1] = g, pixel[2] = b;
    }
  return image;
}

/// Values in [0, scale), from a generator of its own: std's distributions differ between libraries.
inline Image noise(int width, int height, std::uint64_t seed, float scale) {
  Image image(width, height);
  std::uint64_t state = seed * 2862933555777941757u + 3037000493u;
  for (float& value : image.values()) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    value = scale * float(state >> 40) / float(1 << 24);
  }
  return image;
}

/// Makes a picture of value(u, v), where u and v run from -1 to 1. Red is the strongest channel.
template <class Value>
Image reddish(int width, int height, Value value) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double here = value((x + 0.5) / width * 2 - 1, (y + 0.5) / height * 2 - 1);
      const auto pixel = image.pixel(x, y);
      pixel[0] = float(here), pixel[1] = float(0.8 * here), pixel[2] = float(0.6 * here);
    }
  return image;
}

/// A highlight in the middle: exp(-sharpness * distance^2), the sides of the picture at 1.
inline Image highlight(int width, int height, double sharpness, double peak) {
  return reddish(width, height,
                 [&](double u, double v) { return peak * std::exp(-sharpness * (u * u + v * v)); });
}

/// Pixel `index` in reading order, by itself.
inline Rgb shown_at(const DisplayLight& shown, std::size_t index) {
  float rgb[3];
  shown.fill(int(index) / shown.width(), int(index) % shown.width(), rgb);
  return {rgb[0], rgb[1], rgb[2]};
}

inline constexpr HdrExposures kHdrExposures{-2, 2, 3};

/// Every value of a picture uncertain by as much.
inline PictureNoise even_noise(int width, int height, float error, double freedom = 15,
                               bool shared = false) {
  return noise_of_standard_errors(flat(width, height, error, error, error), freedom, shared);
}

inline MetricInput input(const Image& a, const Image& b, const Tolerance* tolerance = nullptr,
                         double exposure_stops = 0) {
  static const std::vector<std::uint8_t> everywhere(std::size_t{1} << 23, 1);
  static const NoiseOfPair kExact{};
  return {a,
          b,
          DisplayLight(a, exposure_stops),
          DisplayLight(b, exposure_stops),
          kDefaultPixelsPerDegree,
          tolerance,
          &kHdrExposures,
          std::span(everywhere).first(a.pixel_count()),
          &kExact,
          std::span(everywhere).first(a.pixel_count())};
}

}  // namespace lobelia::fixtures
