// The catalogue of effects. To add one: write its file, include it here, add it to the list. The plan, the records
// and the tests find it there.
#pragma once

#include "renderer/plan/effects/antialiasing.hpp"
#include "renderer/plan/effects/area_lights.hpp"
#include "renderer/plan/effects/depth_of_field.hpp"
#include "renderer/plan/effects/diffuse.hpp"
#include "renderer/plan/effects/environment.hpp"
#include "renderer/plan/effects/fresnel.hpp"
#include "renderer/plan/effects/glossy.hpp"
#include "renderer/plan/effects/ground.hpp"
#include "renderer/plan/effects/mirror.hpp"
#include "renderer/plan/effects/shadows.hpp"
#include "renderer/plan/plan.hpp"
#include "renderer/type_list.hpp"

namespace lobelia {

/// In the order in which they are decided. Antialiasing is last: it asks which others are on.
using Effects = TypeList<effects::Diffuse, effects::Fresnel, effects::Shadows, effects::AreaLights,
                         effects::Environment, effects::Mirror, effects::Glossy, effects::Ground,
                         effects::DepthOfField, effects::Antialiasing>;

template <class Effect>
bool Plan::on() const {
  return effects[index_of<Effect>(Effects{})].on;
}

}  // namespace lobelia
