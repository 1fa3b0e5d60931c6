// A microfacet BRDF with Smith's shadowing and masking: with the lobe `ggx` it is GGX.
//
//   D = coef * lobe(angle of N from H), with the projected area, the integral of D cos a, equal to 1
//   radiance = D G / (4 (N.L) (N.V)) * (N.L) * E, with F = 1
//
// Not in the paper. The distribution is that of row 6 of its table, and has that row's coefficients; the geometry G is
// Smith's for GGX with alpha^2 = 2 / (n + 2), in place of the implicit (N.L)(N.V).
#include "renderer/models/model.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

/// The catalogue has included the heightfield before.
struct MicrofacetSmith : BlinnPhongHeightfield {
  static constexpr ModelInfo kInfo{
      "microfacet_smith",
      "microfacet (Smith)",
      LobeAngle::kHalfVector,
      true,
      NormalisedQuantity::kProjectedNormals,
      BlinnPhongHeightfield::kInfo.integral,
      "Walter et al. 2007; Heitz 2014, eq. 99; coefficients of row 6 of Romanyuk et al.",
      true};
};
static_assert(Model<MicrofacetSmith>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
