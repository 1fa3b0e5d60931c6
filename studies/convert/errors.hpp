// How far one highlight is from another.
#pragma once

#include "studies/convert/curve.hpp"

namespace lobelia::conversion {

struct Largest {
  double value, angle;  ///< radians
};

/// The largest |a - b|.
Largest largest_difference(const Curve& a, const Curve& b);
/// The largest CIEDE2000, in grey, on a display whose white is the brighter of both peaks.
Largest largest_ciede2000(const Curve& a, const Curve& b);
/// The energy of |a - b|: what arrives at another angle, or not at all. The energy itself does not tell highlights apart,
/// because models are normalised.
double misplaced_energy(const Curve& a, const Curve& b);

}  // namespace lobelia::conversion
