// Phong's model as a reflectance distribution function.
//
//   radiance = coef * lobe(angle of R from V) * E,   0 where N.L <= 0
//
// Row 1 of the paper's table. The irradiance E is measured normal to the beam: there is no N.L by definition. As a
// BRDF (lobe / N.L) it is not reciprocal, contrary to the paper. POV-Ray's `phong albedo` is pi times this
// coefficient.
#include "renderer/models/model.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct PhongRdf {
  static constexpr ModelInfo kInfo{"phong_rdf",
                                   "Phong (RDF)",
                                   LobeAngle::kReflection,
                                   false,
                                   NormalisedQuantity::kRadiance,
                                   "coef 2 pi integral of lobe(x) sin x, x = 0..pi/2",
                                   "Phong 1975; Romanyuk et al., table of coefficients, row 1"};
  static constexpr EnergyIntegral kEnergy{{1, 0, 0, 0}, 1};
  static constexpr double kShare = 1;

  static double paper_cosine(double n) { return (n + 1) / (2 * std::numbers::pi); }
  static double paper_cs16(double n) { return 1.063 * n / (2 * std::numbers::pi); }
  static constexpr CoefficientTexts kTexts{"(n + 1.0) / (2.0 * %pi%)", "(n + 1.0) / (2.0 * %pi%)",
                                           "1.063 * n / (2.0 * %pi%)"};
};
static_assert(Model<PhongRdf>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
