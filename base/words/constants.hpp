// Constants that many files use.
#pragma once

#include <limits>
#include <numbers>

namespace lobelia {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kRightAngle = kPi / 2;  ///< radians
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace lobelia
