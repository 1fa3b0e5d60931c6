// CIE 1976 L*a*b* (CIE 15:2004, 8.2.1), shared by the perceptual metrics.
#pragma once

#include <cmath>

namespace lobelia {

struct Lab {
  double l = 0, a = 0, b = 0;
  friend constexpr bool operator==(const Lab&, const Lab&) = default;
};

/// From tristimulus values already divided by those of the white: X/Xn, Y/Yn, Z/Zn.
inline Lab lab_from_relative_xyz(double x, double y, double z) {
  constexpr double kDelta = 6.0 / 29.0;
  const auto f = [](double t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29.0;
  };
  const double fx = f(x), fy = f(y), fz = f(z);
  return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

}  // namespace lobelia
