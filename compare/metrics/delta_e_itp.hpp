// The colour difference delta E ITP of two colours.
#pragma once

#include "compare/metrics/pixel_differences.hpp"
#include "core/vec.hpp"

namespace lobelia {

/// ICtCp with its Ct halved: a space in which distance is about visible difference.
struct Itp {
  double i, t, p;
};

/// PQ's signal, [0, 1], for that luminance in cd/m2 (ITU-R BT.2100-2, Table 4, inverse EOTF).
double pq_signal(double luminance);

/// Linear light of a display, each in [0, 1], Rec. 709 primaries, its white at 203 cd/m2.
Itp itp_from_display(Rgb shown);

double delta_e_itp(Itp a, Itp b);

/// That of each pixel.
PixelDifferences delta_e_itp_of_pixels(const DisplayLight& a, const DisplayLight& b);

}  // namespace lobelia
