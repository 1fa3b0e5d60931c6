// Smith's shadowing and masking by the microfacets of GGX, height-correlated, over the implicit geometry (N.L)(N.V).
//
//   G = 1 / (1 + Lambda(L) + Lambda(V)),   2 Lambda(c) = sqrt(1 + alpha^2 tan^2) - 1
//   G / ((N.L) (N.V)) = 2 / ((N.L) root(N.V) + (N.V) root(N.L)),   root(c) = sqrt(alpha^2 + (1 - alpha^2) c^2)
//
// Source: Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", eq. 72 and 99. Written as
//         one quotient, which stays finite towards grazing and has no difference.
#include "renderer/real.hpp"

#if defined(LOBELIA_RENDERER_MODELS_SMITH_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_MODELS_SMITH_HPP
#undef LOBELIA_RENDERER_MODELS_SMITH_HPP
#else
#define LOBELIA_RENDERER_MODELS_SMITH_HPP
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

/// For cosines above 0; 1 at normal incidence.
template <class Real>
Real smith_factor(double alpha_squared, Real n_dot_l, Real n_dot_v) {
  using std::sqrt;
  const Real least = Real(alpha_squared), rest = Real(1 - alpha_squared);
  const Real root_l = sqrt(multiply_add(rest * n_dot_l, n_dot_l, least));
  const Real root_v = sqrt(multiply_add(rest * n_dot_v, n_dot_v, least));
  return Real(2.0) / multiply_add(n_dot_l, root_v, n_dot_v * root_l);
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
