// A highlight in long double (64 binary digits on x86), to find the worst of many cases with. What is
// found is then judged by reference_scenes/engines/analytic/formulas/.
#pragma once

#include "verify/stability/random_vectors.hpp"

namespace lobelia::stability {

struct ScreenedVectors {
  Vec3 normal, to_eye, to_light;  ///< unit, correctly rounded to double
  long double s, n_dot_l;         ///< of the unrounded ones
  double half_length;             ///< |L + V|
};
ScreenedVectors screen(LobeAngle angle, const Triple& directions);

long double screened_lobe(LobeId lobe, long double s, double exponent);

}  // namespace lobelia::stability
