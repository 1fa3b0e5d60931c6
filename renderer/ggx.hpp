// GGX: the microfacet distribution of Trowbridge and Reitz, with Smith's shadowing and masking.
//
//   D(a) = alpha^2 / (pi (cos^2 a (alpha^2 - 1) + 1)^2), a the angle of N from H; the integral of D cos a is 1
//   G    = 1 / (1 + Lambda(L) + Lambda(V)), height-correlated; 2 Lambda(c) = sqrt(1 + alpha^2 tan^2) - 1
//   radiance = D G F / (4 (N.L) (N.V)) * (N.L) * E
//
// Source:     Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 33; Heitz 2014,
//             "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", eq. 72 and 99.
// Deviations: D is a function of s = 1 - cos a, because the bracket above is alpha^2 + (1 - alpha^2) sin^2 a, with
//             sin^2 a = s (2 - s): a sum of positive terms, where 1 - cos^2 a would lose the digits of a small alpha.
//             G is divided by 4 (N.L) (N.V) before it is computed, so that it stays finite towards grazing.
// Parameters: alpha, 1e-4 to 1. Roughness is its root, as in Blender and in glTF.
#pragma once

#include <cmath>
#include <numbers>

#include "renderer/models/smith.hpp"

namespace lobelia {

inline constexpr double kMinAlpha = 1e-4, kMaxAlpha = 1;

/// D by s = 1 - N.H, 0 to 1; per steradian.
template <class Real>
Real ggx_distribution(Real alpha, Real s) {
  const Real alpha2 = alpha * alpha;
  const Real share = alpha / (alpha2 + (1 - alpha2) * s * (2 - s));
  return share * share / std::numbers::pi_v<Real>;
}

/// G / (4 (N.L) (N.V)), for cosines above 0.
inline double ggx_visibility(double alpha, double n_dot_l, double n_dot_v) {
  return HWY_NAMESPACE::smith_factor(alpha * alpha, n_dot_l, n_dot_v) / 4;
}

}  // namespace lobelia
