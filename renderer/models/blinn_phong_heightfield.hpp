// Blinn-Phong as a normal distribution of a heightfield.
//
//   D = coef * lobe(angle of N from H), whose projected area integral of D cos a is 1
//   radiance = D / 4 * (N.L) * E, with implicit geometry and F = 1
//
// Row 6 of the paper's table. As the NDF, but normalised to the area of the plane beneath.
#include "renderer/models/model.hpp"

#if defined(LOBELIA_RENDERER_MODELS_BLINN_PHONG_HEIGHTFIELD_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_MODELS_BLINN_PHONG_HEIGHTFIELD_HPP
#undef LOBELIA_RENDERER_MODELS_BLINN_PHONG_HEIGHTFIELD_HPP
#else
#define LOBELIA_RENDERER_MODELS_BLINN_PHONG_HEIGHTFIELD_HPP
#endif

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

  template <class Real>
  static Real foreshortening(Real n_dot_l) {
    return n_dot_l;
  }

  static double paper_cosine(double n) { return (n + 2) / (2 * std::numbers::pi); }
  static double paper_cs16(double n) { return (1.063 * n + 1) / (2 * std::numbers::pi); }
  static constexpr CoefficientTexts kTexts{"(n + 2.0) / (2.0 * %pi%)", "(n + 2.0) / (2.0 * %pi%)",
                                           "(1.063 * n + 1.0) / (2.0 * %pi%)"};
};
static_assert(Model<BlinnPhongHeightfield>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
