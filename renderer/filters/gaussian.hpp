// A Gaussian with a standard deviation of radius / 3, lowered to reach 0 at the radius, like Mitsuba's and pbrt's.
// The default radius gives their standard deviation of half a pixel.
#pragma once

#include <cmath>
#include <string_view>

namespace lobelia::filters {

struct Gaussian {
  static constexpr std::string_view kName = "gaussian";
  static constexpr double kRadius = 1.5;
  static double value(double x) { return std::exp(-4.5 * x * x) - std::exp(-4.5); }
};

}  // namespace lobelia::filters
