// The filters, and their catalogue. To add one: write its structure and add it to the list.
#pragma once

#include <cmath>
#include <numbers>
#include <string_view>

#include "renderer/type_list.hpp"

namespace lobelia {

namespace filters {

/// The mean over a square.
struct Box {
  static constexpr std::string_view kName = "box";
  static constexpr double kRadius = 0.5;
  static double value(double) { return 1; }
};

/// Linear interpolation between pixels' centres.
struct Tent {
  static constexpr std::string_view kName = "tent";
  static constexpr double kRadius = 1;
  static double value(double x) { return 1 - std::abs(x); }
};

/// A Gaussian with a standard deviation of radius / 3, lowered to reach 0 at the radius, like Mitsuba's and pbrt's.
/// The default radius gives their standard deviation of half a pixel.
struct Gaussian {
  static constexpr std::string_view kName = "gaussian";
  static constexpr double kRadius = 1.5;
  static double value(double x) { return std::exp(-4.5 * x * x) - std::exp(-4.5); }
};

/// The four-term Blackman-Harris window (Harris 1978), the default of Blender's Cycles.
struct BlackmanHarris {
  static constexpr std::string_view kName = "blackman_harris";
  static constexpr double kRadius = 0.75;  ///< Cycles: a width of 1.5 pixels
  static double value(double x) {
    const double t = std::numbers::pi * (x + 1);
    return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
  }
};

/// Mitchell and Netravali 1988 with B = C = 1/3: sharper than a Gaussian, because it is negative from 4/7 of its
/// radius on. A picture may overshoot beside an edge, even below 0.
struct Mitchell {
  static constexpr std::string_view kName = "mitchell";
  static constexpr double kRadius = 2;
  static double value(double x) {
    const double t = 2 * std::abs(x), b = 1.0 / 3, c = 1.0 / 3;
    if (t < 1)
      return ((12 - 9 * b - 6 * c) * t * t * t + (12 * b + 6 * c - 18) * t * t + 6 - 2 * b) / 6;
    return ((-b - 6 * c) * t * t * t + (6 * b + 30 * c) * t * t - (12 * b + 48 * c) * t + 8 * b +
            24 * c) /
           6;
  }
};

}  // namespace filters

/// The box is first: it is the default. Each value() is for x in [-1, 1], in units of the radius.
using Filters = TypeList<filters::Box, filters::Tent, filters::Gaussian, filters::BlackmanHarris,
                         filters::Mitchell>;

}  // namespace lobelia
