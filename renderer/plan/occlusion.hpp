// Which surfaces may stand between another one and a light.
#pragma once

#include "renderer/plan/plan.hpp"

namespace lobelia {

/// occluders[light][surface], conservative: what is left out can shadow no point of the surface. All
/// others for EffectPolicy::kAll. One entry for every surface, with any sphere in it, where there are more
/// than kMaxPairwiseSpheres.
std::vector<std::vector<Occluders>> find_occluders(const Scene& scene, const Contacts& contacts,
                                                   EffectPolicy policy);

}  // namespace lobelia
