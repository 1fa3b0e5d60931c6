// What a lobe looks like at one exponent, measured on the lobe itself.
#pragma once

#include "renderer/highlight.hpp"

namespace lobelia {

struct LobeProperties {
  double half_width;  ///< angle at which it has fallen to half, radians; pi/2 if it nowhere does
  double support;     ///< angle beyond which it is 0, radians; pi/2 at most
  double above_cosine, below_cosine;  ///< most by which it is above and below cos^n, of the peak
};

LobeProperties measure(LobeId lobe, double exponent);

}  // namespace lobelia
