// Every light, once: its file and a place in this list are all that one takes.
#include "renderer/scene/lights/constant.hpp"
#include "renderer/scene/lights/directional.hpp"
#include "renderer/scene/lights/envmap.hpp"
#include "renderer/scene/lights/point.hpp"
#include "renderer/scene/lights/rectangle.hpp"
#include "renderer/scene/lights/sphere.hpp"

#ifndef LOBELIA_RENDERER_SCENE_LIGHTS_CATALOGUE_HPP
#define LOBELIA_RENDERER_SCENE_LIGHTS_CATALOGUE_HPP

#include "renderer/type_list.hpp"

namespace lobelia {

/// In the order of the page of the scene format.
using Lights =
    TypeList<DirectionalLight, PointLight, SphereLight, RectangleLight, ConstantLight, EnvmapLight>;

}  // namespace lobelia

#endif
