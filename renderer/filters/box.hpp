// The mean over a square.
#pragma once

#include <string_view>

namespace lobelia::filters {

struct Box {
  static constexpr std::string_view kName = "box";
  static constexpr double kRadius = 0.5;
  /// x in [-1, 1], in units of the radius.
  static double value(double) { return 1; }
};

}  // namespace lobelia::filters
