// Blinn-Phong as a normal distribution, normalised over the hemisphere.
//
//   D = coef * lobe(angle of N from H),   f_r = D F / 4 with implicit geometry G = (N.L)(N.V)
//   radiance = D / 4 * (N.L) * E, with F = 1
//
// Row 5 of the paper's table. A distribution of normals, not of reflected light: as an RDF it would reflect four
// times the energy.
#include "renderer/models/model.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct BlinnPhongNdf {
  static constexpr ModelInfo kInfo{"blinn_phong_ndf",
                                   "Blinn-Phong (NDF)",
                                   LobeAngle::kHalfVector,
                                   true,
                                   NormalisedQuantity::kNormals,
                                   "coef 2 pi integral of lobe(a) sin a, a = 0..pi/2",
                                   "Blinn 1977; Romanyuk et al., table of coefficients, row 5"};
  static constexpr EnergyIntegral kEnergy{{1, 0, 0, 0}, 1};
  static constexpr double kShare = 0.25;

  static double paper_cosine(double n) { return (n + 1) / (2 * std::numbers::pi); }
  static double paper_cs16(double n) { return 1.063 * n / (2 * std::numbers::pi); }
  static constexpr CoefficientTexts kTexts{"(n + 1.0) / (2.0 * %pi%)", "(n + 1.0) / (2.0 * %pi%)",
                                           "1.063 * n / (2.0 * %pi%)"};
};
static_assert(Model<BlinnPhongNdf>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
