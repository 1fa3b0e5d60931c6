// The modified Phong model, a BRDF.
//
//   radiance = coef * lobe(angle of R from V) * (N.L) * E
//
// Row 2 of the paper's table. f_r = coef * lobe; reciprocal, because R.V = L.R_V.
#include "renderer/models/model.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct ModifiedPhong {
  static constexpr ModelInfo kInfo{
      "modified_phong",
      "modified Phong",
      LobeAngle::kReflection,
      true,
      NormalisedQuantity::kRadiance,
      "coef 2 pi integral of lobe(x) cos x sin x, x = 0..pi/2",
      "Lewis 1994; Lafortune and Willems 1994; Romanyuk et al., table of coefficients, row 2"};
  static constexpr EnergyIntegral kEnergy{{1, -1, 0, 0}, 1};
  static constexpr double kShare = 1;

  static double paper_cosine(double n) { return (n + 2) / (2 * std::numbers::pi); }
  static double paper_cs16(double n) { return (1.063 * n + 1) / (2 * std::numbers::pi); }
  static constexpr CoefficientTexts kTexts{"(n + 2.0) / (2.0 * %pi%)", "(n + 2.0) / (2.0 * %pi%)",
                                           "(1.063 * n + 1.0) / (2.0 * %pi%)"};
};
static_assert(Model<ModifiedPhong>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
