// The hard cases, by lobe: whatever stands in the catalogue of lobes is taken through all of them.
#pragma once

#include <array>
#include <vector>

#include "studies/stability/row.hpp"

namespace lobelia::stability {

inline constexpr std::array kExponents{0.1, 1.0, 2.0, 15.9, 16.0, 1024.0, 1e4, 1e6, 1e8};

/// Every lobe that is listed, and two of the family cs_k that are not: an order that is no power of two,
/// and the largest.
std::vector<LobeId> lobes_under_test();

/// The lobe alone in float32 at a float32 s: at the angles that are hard, at its end, and where it is
/// about to be no normal number any more. The bounds are those that the lobe's file states.
Rows lobe_rows(LobeId lobe);

/// The coefficient of every model, by closed form or moments, to kCoefficientBound of itself.
inline constexpr double kCoefficientBound = 1e-14;
Rows coefficient_rows(LobeId lobe);

/// Vectors that are hard: in the kernels, at the precision that the plan would choose, and in
/// Reflector, which takes any. The bound is shading_error_bound; twice that for Reflector, which
/// normalises them first; its pdf must be a number too.
Rows vector_rows(LobeId lobe);

/// The density of samples over s, down to its underflow: never denormal, never below 0, and to kDensityBound of its
/// peak. An exponential of x nats is off by x e^-x of the peak for each rounding of x: 0.37 of a rounding at most.
inline constexpr double kDensityBound = 1e-13;
Rows density_rows(LobeId lobe);

/// Scenes of spheres rendered whole, and close to the highlight; to kAllowedShadingError of the peak.
Rows sphere_rows(LobeId lobe);

/// 1e5 random vectors, grazing ones among them, and the worst of them made worse: for each precision
/// against its stated bound, and for the precision that is chosen against kAllowedShadingError. The
/// naive formula has seen some of them. Of several lobes, which see the same vectors.
Rows precision_rows(const std::vector<LobeId>& lobes, double exponent);

}  // namespace lobelia::stability
