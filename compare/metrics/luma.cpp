#include "compare/metrics/luma.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace lobelia {
namespace {

double encoded(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

LumaPlane plane(int width, int height) {
  return {width, height, std::vector<float>(std::size_t(width) * std::size_t(height))};
}

}  // namespace

LumaPlane luma(const DisplayLight& shown) {
  LumaPlane result = plane(shown.width(), shown.height());
  oneapi::tbb::parallel_for(0, shown.height(), [&](int y) {
    const std::size_t first = std::size_t(y) * std::size_t(shown.width());
    for (std::size_t i = first; i < first + std::size_t(shown.width()); ++i) {
      const Rgb light = shown.at(i);
      // A grey is the grey itself: the weights add up to 1, their rounded products do not.
      const double value =
          light.r == light.g && light.g == light.b
              ? encoded(light.r)
              : 0.2126 * encoded(light.r) + 0.7152 * encoded(light.g) + 0.0722 * encoded(light.b);
      result.values[i] = float(value);
    }
  });
  return result;
}

LumaPlane half_size(const LumaPlane& whole) {
  LumaPlane result = plane((whole.width + 1) / 2, (whole.height + 1) / 2);
  for (int y = 0; y < result.height; ++y) {
    const float* upper = whole.row(2 * y);
    const float* lower = whole.row(std::min(2 * y + 1, whole.height - 1));
    for (int x = 0; x < result.width; ++x) {
      const int left = 2 * x, right = std::min(left + 1, whole.width - 1);
      result.values[std::size_t(y) * std::size_t(result.width) + std::size_t(x)] =
          ((upper[left] + upper[right]) + (lower[left] + lower[right])) / 4;
    }
  }
  return result;
}

}  // namespace lobelia
