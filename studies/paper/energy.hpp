// The energy that a row of the paper's table reflects at normal incidence: its coefficient times the integral that it
// should make 1, by Gauss-Kronrod quadrature in long double.
#pragma once

#include "studies/paper/claim.hpp"

namespace lobelia::paper {

/// The end of the integral over the angle x.
enum class Cut {
  kSupport,  ///< where the lobe ends, or at a right angle: a half-angle lobe is twice as wide in x
  kPrinted   ///< at 6/sqrt(n), as the paper's integral of cs16 has it
};

/// 2 pi times the integral of lobe(x or x/2) [cos x] sin x over x.
Real hemisphere_integral(const Row& row, Lobe lobe, Real n, Cut cut = Cut::kSupport);

inline Real energy(const Row& row, Lobe lobe, Real n, Cut cut = Cut::kSupport) {
  return row.column(lobe)(n) * hemisphere_integral(row, lobe, n, cut);
}

/// The energy of Schlick's lobe: 2 pi times the integral of schlick(x) sin x, x = 0..pi/2.
Real schlick_integral(Real n);

enum class Held { kBeam, kEye };

/// The share of power that a model reflects at any incidence. Two definitions, which agree for reciprocal models only:
///   kBeam  a beam arrives at the angle theta: reflected power / arriving power,
///          the integral over to_eye of radiance (N.V) / (N.L). This is conservation of energy.
///   kEye   an eye looks at the angle theta in surroundings of radiance 1: the radiance that it sees,
///          the integral over to_light of radiance per unit irradiance. The paper normalises this.
///
/// `coefficient` multiplies the lobe; a distribution D reflects f_r = D / 4 (implicit geometry).
double albedo(const Row& row, Lobe lobe, Real n, Real coefficient, double theta, Held held);

}  // namespace lobelia::paper
