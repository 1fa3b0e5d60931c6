// The catalogue of lights. To add one: write its file, include it here, add it to the list.
#include "renderer/scene/lights/constant.hpp"
#include "renderer/scene/lights/directional.hpp"
#include "renderer/scene/lights/envmap.hpp"
#include "renderer/scene/lights/point.hpp"
#include "renderer/scene/lights/rectangle.hpp"
#include "renderer/scene/lights/sphere.hpp"
#include "renderer/scene/lights/spot.hpp"

#ifndef LOBELIA_RENDERER_SCENE_LIGHTS_CATALOGUE_HPP
#define LOBELIA_RENDERER_SCENE_LIGHTS_CATALOGUE_HPP

#include "renderer/type_list.hpp"

namespace lobelia {

/// In the order of docs/scene_format.md.
using Lights = TypeList<DirectionalLight, PointLight, SpotLight, SphereLight, RectangleLight,
                        ConstantLight, EnvmapLight>;

}  // namespace lobelia

#endif
