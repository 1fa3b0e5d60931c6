// How much a highlight reflects at each incidence. A normalised model reflects energy 1 at normal
// incidence; these say by quadrature what becomes of it elsewhere, and whether the model treats light
// and eye alike. Every model and every lobe of the catalogues is measured the same way.
#pragma once

#include <numbers>
#include <optional>

#include "renderer/highlight.hpp"

namespace lobelia {

/// Up to here, in radians, incidences are looked at: 89.99 degrees.
inline constexpr double kMostGrazing = 89.99 / 180 * std::numbers::pi;

/// Radiance towards an eye `incidence` radians off the normal, 0 to below pi/2, under a uniform sky of
/// radiance 1: the integral of eval over to_light. To about 1e-10 of itself, in some 50 microseconds.
double directional_albedo(const Highlight& highlight, double incidence);

/// The share of a beam that is reflected if it arrives `incidence` radians off the normal: the integral of
/// eval (N.V) over to_eye, over N.L. The same number as directional_albedo for a reciprocal model; an
/// RDF's grows without bound towards grazing, where little light arrives but the highlight is as bright.
double directional_albedo_of_light(const Highlight& highlight, double incidence);

struct AlbedoPeak {
  double albedo, incidence;  ///< radians
  std::optional<double>
      above_one_from;  ///< the smallest incidence at which more than 1 is reflected
};

/// The largest of the above over incidences from 0 to kMostGrazing, and the smallest incidence that
/// comes within 1e-9 of it; what exceeds 1 by less than 1e-9 is rounding.
AlbedoPeak largest_albedo(const Highlight& highlight);
AlbedoPeak largest_albedo_of_light(const Highlight& highlight);

/// How far the highlight is from Helmholtz reciprocity: with f_r = eval / (N.L), the largest
/// |f_r(L, V) - f_r(V, L)| relative to the larger of the two, over eyes from 5 to 85 degrees and lights
/// across the lobe of each. 0, rounding apart, for a BRDF; below 1 always.
double reciprocity_gap(const Highlight& highlight);

}  // namespace lobelia
