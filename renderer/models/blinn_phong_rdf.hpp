// The Blinn-Phong model as a reflectance distribution function.
//
//   radiance = coef * lobe(angle of N from H) * E,   0 where N.L <= 0
//
// Row 3 of the paper's table. The paper's fit for cs16 integrates the half-angle lobe only up to 6/sqrt(n), half of
// its support; over the true support its energy is up to 5.2e-3 above 1. POV-Ray's `specular albedo` is pi times
// the cosine coefficient.
#include "renderer/models/model.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct BlinnPhongRdf {
  static constexpr ModelInfo kInfo{"blinn_phong_rdf",
                                   "Blinn-Phong (RDF)",
                                   LobeAngle::kHalfVector,
                                   false,
                                   NormalisedQuantity::kRadiance,
                                   "coef 2 pi integral of lobe(x/2) sin x, x = 0..pi/2",
                                   "Blinn 1977; Romanyuk et al., table of coefficients, row 3"};
  static constexpr EnergyIntegral kEnergy{{4, -4, 0, 0}, kHalfOfRightAngle};
  static constexpr double kShare = 1;

  static double paper_cosine(double n) {
    return (n + 2) / (4 * std::numbers::pi * (2 - std::exp2(-n / 2)));
  }
  static double paper_cs16(double n) { return (1.068 * n + 0.96) / (8 * std::numbers::pi); }
  static constexpr CoefficientTexts kTexts{"(n + 2.0) / (4.0 * %pi% * (2.0 - exp2(-0.5 * n)))",
                                           "(n + 2.0) / (4.0 * %pi% * (2.0 - exp2(-0.5 * n)))",
                                           "(1.068 * n + 0.96) / (8.0 * %pi%)"};
};
static_assert(Model<BlinnPhongRdf>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
