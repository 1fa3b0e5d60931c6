// The catalogue of models. To add one: write its file, include it here, add it to the list. Tests,
// command line, scene reader and documentation find it there.
#if defined(LOBELIA_RENDERER_MODELS_CATALOGUE_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_MODELS_CATALOGUE_HPP
#undef LOBELIA_RENDERER_MODELS_CATALOGUE_HPP
#else
#define LOBELIA_RENDERER_MODELS_CATALOGUE_HPP
#endif

#include "renderer/models/blinn_phong_heightfield.hpp"
#include "renderer/models/blinn_phong_ndf.hpp"
#include "renderer/models/blinn_phong_rdf.hpp"
#include "renderer/models/microfacet_smith.hpp"
#include "renderer/models/modified_blinn_phong.hpp"
#include "renderer/models/modified_phong.hpp"
#include "renderer/models/phong_rdf.hpp"
#include "renderer/type_list.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

using Models = TypeList<PhongRdf, ModifiedPhong, BlinnPhongRdf, ModifiedBlinnPhong, BlinnPhongNdf,
                        BlinnPhongHeightfield, MicrofacetSmith>;

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
