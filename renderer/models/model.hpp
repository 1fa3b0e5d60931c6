// A model: the angle that its lobe sees, whether radiance carries N.L, and the coefficient that makes the reflected
// energy 1 at normal incidence.
//
//   radiance per unit irradiance normal to the beam
//     = kShare * coefficient * lobe(s, n) * (N.L, unless it is an RDF)
//       * (Smith's G / ((N.L) (N.V)), where the model has shadowing),   0 where N.L <= 0
//
// Compiled once for each instruction set, as lobes are (renderer/lobes/lobe.hpp).
#pragma once

#include "renderer/lobes/lobe.hpp"

namespace lobelia {

/// The integral that the coefficient makes 1, over s = 1 - cos of the lobe's angle:
///   energy = coefficient * 2 pi * sum over j of weights[j] * integral of lobe(s) s^j, 0..s_max.
/// For the half-vector models the lobe's angle is half the angle x of the reflected ray, so
/// sin x dx = 4 (1 - s) ds, cos x = 1 - 4 s + 2 s^2, and x = pi/2 is s = 1 - cos(pi/4).
struct EnergyIntegral {
  std::array<double, 4> weights;
  double s_max;
};

inline constexpr double kHalfOfRightAngle = 1 - std::numbers::sqrt2 / 2;  ///< 1 - cos(pi/4)

/// 1 / (2 pi sum of weights[j] M_j), with the moments M_j of the lobe.
double exact_coefficient(const EnergyIntegral& energy, const auto& lobe) {
  double sum = 0;
  for (int j = 0; j < 4; ++j)
    if (energy.weights[j] != 0) sum += energy.weights[j] * lobe.moment(j, energy.s_max);
  return 1 / (2 * std::numbers::pi * sum);
}

/// Coefficients as formulas of n in what shader languages have in common, for `lobelia export` and for people:
/// the true one for cos^n and the paper's two columns. Every number has a decimal point, every product a sign.
struct CoefficientTexts {
  std::string_view exact_cosine, paper_cosine, paper_cs16;
};

template <class M>
concept Model = requires(double n) {
  { M::kInfo } -> std::convertible_to<const ModelInfo&>;
  { M::kEnergy } -> std::convertible_to<const EnergyIntegral&>;
  /// 1; or 1/4 for a microfacet distribution D, because f_r = D F / 4.
  { M::kShare } -> std::convertible_to<double>;
  /// The coefficients as the paper prints them, misprints included.
  { M::paper_cosine(n) } -> std::same_as<double>;
  { M::paper_cs16(n) } -> std::same_as<double>;
  { M::kTexts } -> std::convertible_to<const CoefficientTexts&>;
};

}  // namespace lobelia
