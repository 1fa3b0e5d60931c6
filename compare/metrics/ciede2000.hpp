// The colour difference CIEDE2000 of two colours.
#pragma once

#include "base/words/vec.hpp"
#include "compare/metrics/pixel_differences.hpp"

namespace lobelia {

/// CIE 1976 L*a*b* (CIE 15:2004, 8.2.1).
struct Lab {
  double l = 0, a = 0, b = 0;
  friend constexpr bool operator==(const Lab&, const Lab&) = default;
};

/// With the parametric factors k_L = k_C = k_H = 1.
double ciede2000(Lab a, Lab b);

/// Linear light of an sRGB display, each in [0, 1], as Lab under its white (D65).
Lab lab_from_display(Rgb shown);

/// CIEDE2000 of each pixel.
/// See pixel_differences().
PixelValues ciede2000_of_pixels(const DisplayLight& a, const DisplayLight& b,
                                std::span<const std::uint8_t> needed = {});

}  // namespace lobelia
