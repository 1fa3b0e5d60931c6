// The four-term Blackman-Harris window (Harris 1978), the default of Blender's Cycles.
#pragma once

#include <cmath>
#include <numbers>
#include <string_view>

namespace lobelia::filters {

struct BlackmanHarris {
  static constexpr std::string_view kName = "blackman_harris";
  static constexpr double kRadius = 0.75;  ///< Cycles: a width of 1.5 pixels
  static double value(double x) {
    const double t = std::numbers::pi * (x + 1);
    return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
  }
};

}  // namespace lobelia::filters
