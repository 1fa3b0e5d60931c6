// The colour difference delta E ITP of two colours.
#pragma once

#include "base/words/vec.hpp"
#include "compare/metrics/pixel_differences.hpp"

namespace lobelia {

/// ICtCp with its Ct halved. Distances in this space are about visible differences.
struct Itp {
  double i, t, p;
};

/// From linear light of a display, Rec. 709 primaries; 1 is its white, 203 cd/m2.
Itp itp_from_display(Rgb shown);

double delta_e_itp(Itp a, Itp b);

/// Delta E ITP of each pixel.
/// See pixel_differences().
PixelValues delta_e_itp_of_pixels(const DisplayLight& a, const DisplayLight& b,
                                  std::span<const std::uint8_t> needed = {});

}  // namespace lobelia
