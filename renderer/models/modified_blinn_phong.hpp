// The modified Blinn-Phong model, a BRDF.
//
//   radiance = coef * lobe(angle of N from H) * (N.L) * E
//
// Row 4 of the paper's table. The paper prints 4 pi in the cosine column, which reflects twice the energy that
// arrives; 8 pi is right, and agrees with the paper's own bounds. The normalisation "paper" has the printed
// constant. The paper's fit for cs16 loses up to 5.6 % of the energy.
#include "renderer/models/model.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct ModifiedBlinnPhong {
  static constexpr ModelInfo kInfo{
      "modified_blinn_phong",
      "modified Blinn-Phong",
      LobeAngle::kHalfVector,
      true,
      NormalisedQuantity::kRadiance,
      "coef 2 pi integral of lobe(x/2) cos x sin x, x = 0..pi/2",
      "Giesen 2009 (normalisation); Romanyuk et al., table of coefficients, row 4"};
  static constexpr EnergyIntegral kEnergy{{4, -20, 24, -8}, kHalfOfRightAngle};
  static constexpr double kShare = 1;

  static double paper_cosine(double n) {
    return (n + 2) * (n + 4) / (4 * std::numbers::pi * (std::exp2(-n / 2) + n));
  }
  static double paper_cs16(double n) { return (1.027 * n + 4.8) / (8 * std::numbers::pi); }
  static constexpr CoefficientTexts kTexts{
      "(n + 2.0) * (n + 4.0) / (8.0 * %pi% * (exp2(-0.5 * n) + n))",
      "(n + 2.0) * (n + 4.0) / (4.0 * %pi% * (exp2(-0.5 * n) + n))",
      "(1.027 * n + 4.8) / (8.0 * %pi%)"};
};
static_assert(Model<ModifiedBlinnPhong>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
