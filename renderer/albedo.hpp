// The energy that a highlight reflects at each incidence, by quadrature, and its reciprocity. A normalised model
// reflects energy 1 at normal incidence. Every model and lobe is measured the same way.
#pragma once

#include <numbers>
#include <optional>

#include "renderer/highlight.hpp"

namespace lobelia {

/// The largest incidence that is measured, in radians: 89.99 degrees.
inline constexpr double kMostGrazing = 89.99 / 180 * std::numbers::pi;

/// Radiance towards an eye `incidence` radians off the normal, 0 to below pi/2, under a uniform sky of
/// radiance 1: the integral of eval over to_light. Relative error about 1e-10; takes some 50 microseconds.
double directional_albedo(const Highlight& highlight, double incidence);

/// The share of a beam that is reflected if it arrives `incidence` radians off the normal: the integral of eval (N.V)
/// over to_eye, over N.L. Equals directional_albedo for a reciprocal model. For an RDF it grows without bound towards
/// grazing, where little light arrives but the highlight stays as bright.
double directional_albedo_of_light(const Highlight& highlight, double incidence);

struct AlbedoPeak {
  double albedo, incidence;              ///< radians
  std::optional<double> above_one_from;  ///< the smallest incidence that reflects more than 1
};

/// The largest of the above over incidences from 0 to kMostGrazing, at the smallest incidence that comes within
/// 1e-9 of it. An excess over 1 of less than 1e-9 counts as rounding.
AlbedoPeak largest_albedo(const Highlight& highlight);
AlbedoPeak largest_albedo_of_light(const Highlight& highlight);

/// The deviation from Helmholtz reciprocity: with f_r = eval / (N.L), the largest |f_r(L, V) - f_r(V, L)| relative
/// to the larger of the two, over eyes from 5 to 85 degrees and lights across the lobe of each. 0 up to rounding
/// for a BRDF; always below 1.
double reciprocity_gap(const Highlight& highlight);

}  // namespace lobelia
