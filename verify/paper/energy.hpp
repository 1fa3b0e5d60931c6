// The energy that a row of the paper's table reflects at normal incidence: its coefficient times the
// integral that it is to make 1, by Gauss-Kronrod quadrature in long double.
#pragma once

#include "reference_scenes/engines/analytic/formulas/printed.hpp"

namespace lobelia::paper {

/// Where the integral over the angle x ends.
enum class Cut {
  kSupport,  ///< where the lobe does, or at a right angle: a half-angle lobe is twice as wide in x
  kPrinted   ///< at 6/sqrt(n), as the paper's integral of cs16 has it
};

/// 2 pi times the integral of lobe(x or x/2) [cos x] sin x over x.
Real hemisphere_integral(const Row& row, Lobe lobe, Real n, Cut cut = Cut::kSupport);

inline Real energy(const Row& row, Lobe lobe, Real n, Cut cut = Cut::kSupport) {
  return row.column(lobe)(n) * hemisphere_integral(row, lobe, n, cut);
}

/// 2 pi times the integral of schlick(x) sin x, x = 0..pi/2: what Schlick's lobe carries.
Real schlick_integral(Real n);

}  // namespace lobelia::paper
