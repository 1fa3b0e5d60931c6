// The share of power that a model reflects at any incidence, not at normal incidence alone.
//
// Two questions that have one answer for a reciprocal model, and two for a model that is not:
//   kBeam  a beam arrives at the angle theta: reflected power / arriving power,
//          the integral over to_eye of radiance (N.V) / (N.L). This is conservation of energy.
//   kEye   an eye looks at the angle theta in surroundings of radiance 1: the radiance that it sees,
//          the integral over to_light of radiance per unit irradiance. The paper normalises this.
#pragma once

#include "reference_scenes/engines/analytic/formulas/printed.hpp"

namespace lobelia::paper {

enum class Held { kBeam, kEye };

/// `coefficient` multiplies the lobe; a distribution D reflects f_r = D / 4 (implicit geometry).
double albedo(const Row& row, Lobe lobe, Real n, Real coefficient, double theta, Held held);

}  // namespace lobelia::paper
