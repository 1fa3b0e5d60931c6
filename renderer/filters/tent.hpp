// Linear interpolation between pixels' centres.
#pragma once

#include <cmath>
#include <string_view>

namespace lobelia::filters {

struct Tent {
  static constexpr std::string_view kName = "tent";
  static constexpr double kRadius = 1;
  static double value(double x) { return 1 - std::abs(x); }
};

}  // namespace lobelia::filters
