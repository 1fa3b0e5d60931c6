// The catalogue of lobes. To add one: write its file, include it here, add it to the list. Tests,
// command line, scene reader and documentation find it there.
#if defined(LOBELIA_RENDERER_LOBES_CATALOGUE_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_LOBES_CATALOGUE_HPP
#undef LOBELIA_RENDERER_LOBES_CATALOGUE_HPP
#else
#define LOBELIA_RENDERER_LOBES_CATALOGUE_HPP
#endif

#include "renderer/lobes/cosine.hpp"
#include "renderer/lobes/cs.hpp"
#include "renderer/lobes/expression.hpp"
#include "renderer/lobes/gauss.hpp"
#include "renderer/lobes/ggx.hpp"
#include "renderer/lobes/pk.hpp"
#include "renderer/lobes/schlick.hpp"
#include "renderer/lobes/spherical_gaussian.hpp"
#include "renderer/type_list.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

using Lobes =
    TypeList<CosineLobe, CsLobe, SphericalGaussianLobe, GaussLobe, SchlickLobe, PkLobe, GgxLobe>;

template <class... Ls>
TypeList<Ls..., ExpressionLobe> with_formulas(TypeList<Ls...>);
/// By LobeId::index: the catalogue, and behind it the lobe that a formula gives.
using LobesById = decltype(with_formulas(Lobes{}));

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
