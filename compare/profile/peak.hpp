// Where a highlight is brightest, to a fraction of a pixel.
//
// The estimate is the maximum of a polynomial that is fitted to the logarithm of the values, weighted by their
// squares (by which equal errors of the values count equally). The logarithm of a Gaussian is a quadratic, and
// that of a power of a cosine on a sphere nearly so: what bends it is a term of third degree, which moves the
// maximum of a quadratic fitted over many pixels. So it is
//   of degree 4 over the cap, the pixels above 4/5 of the peak, where that is at least 3 pixels to each side of
//     its middle along its short axis; all of them count, which keeps noise down; above 9/10 where it is 10;
//   of degree 2 over 3 x 3 pixels, where it is smaller; there third-order terms are small too.
#pragma once

#include "compare/profile/field.hpp"

namespace lobelia {

/// Named by records::kPeakFound.
enum class PeakFound {
  kFitted,   ///< by the polynomial
  kPixel,    ///< to the brightest pixel: no polynomial has a maximum near it
  kPlateau,  ///< to the middle of many pixels of exactly the same value: a clipped or flat picture
  kEdge,  ///< to the brightest pixel, which lies beside a hole or the border: the true peak may be beyond
  kNone,  ///< no value is above 0
};

struct Peak {
  FilmPoint place;   ///< NaN where there is none
  double value = 0;  ///< of the polynomial there, or of the pixel; NaN where there is none
  PeakFound found = PeakFound::kNone;
  std::size_t pixel = 0;  ///< the brightest, in reading order
};

/// Infinite values are holes too. O(pixels).
Peak locate_peak(const Field& field);

}  // namespace lobelia
