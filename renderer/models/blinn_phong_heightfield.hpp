// Blinn-Phong as a normal distribution of a heightfield.
//
//   D = coef * lobe(angle of N from H), with the projected area, the integral of D cos a, equal to 1
//   radiance = D / 4 * (N.L) * E, with implicit geometry and F = 1
//
// Row 6 of the paper's table. Like the NDF, but normalised to the area of the plane below.
#include "renderer/models/model.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct BlinnPhongHeightfield {
  static constexpr ModelInfo kInfo{"blinn_phong_heightfield",
                                   "Blinn-Phong (heightfield)",
                                   LobeAngle::kHalfVector,
                                   true,
                                   NormalisedQuantity::kProjectedNormals,
                                   "coef 2 pi integral of lobe(a) cos a sin a, a = 0..pi/2",
                                   "Romanyuk et al., table of coefficients, row 6"};
  static constexpr EnergyIntegral kEnergy{{1, -1, 0, 0}, 1};
  static constexpr double kShare = 0.25;

  static double paper_cosine(double n) { return (n + 2) / (2 * std::numbers::pi); }
  static double paper_cs16(double n) { return (1.063 * n + 1) / (2 * std::numbers::pi); }
  static constexpr CoefficientTexts kTexts{"(n + 2.0) / (2.0 * %pi%)", "(n + 2.0) / (2.0 * %pi%)",
                                           "(1.063 * n + 1.0) / (2.0 * %pi%)"};
};
static_assert(Model<BlinnPhongHeightfield>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
