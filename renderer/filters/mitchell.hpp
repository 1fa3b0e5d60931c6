// Mitchell and Netravali 1988 with B = C = 1/3: sharper than a Gaussian, because it is negative from 4/7 of its
// radius on. A picture may overshoot beside an edge, even below 0.
#pragma once

#include <cmath>
#include <string_view>

namespace lobelia::filters {

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

}  // namespace lobelia::filters
