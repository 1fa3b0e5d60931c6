// Scenes for small programs that shade by an engine's own highlight: words and numbers, a line for each thing.
//
//   scene NAME                                      of its picture, NAME-0.pfm
//   seconds S                                       after which the program has to give up
//   film WIDTH HEIGHT                               pixels
//   window LEFT RIGHT BOTTOM TOP                    of the film, at distance 1
//   light directional X Y Z R G B                   unit vector to the light, irradiance
//   light point X Y Z R G B                         position, intensity
//   material KIND EXPONENT STRENGTH DR DG DB        diffuse albedo over pi
//   sphere X Y Z RADIUS MATERIAL
//   plane X Y Z NX NY NZ MATERIAL
//   end
//
// All places are in the camera's frame: it is in the origin, x is to the right, y upwards and z away from it. A material's
// kind is the engine's name for a highlight, and STRENGTH the factor in front of it that the engine does not have itself.
// Nothing that a user typed gets in.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "reference_scenes/engine.hpp"
#include "reference_scenes/persistent_session.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// A material's highlight as an engine has it.
struct OwnHighlight {
  std::string_view kind = "none";
  double strength = 0;
};

/// One sentence on what these programs cannot express; empty if they can express the scene: lights that shine to one
/// side, highlights in colour or with a Fresnel factor, mirrors, checkers.
std::string why_not_in_camera_scene(const Scene& scene);

/// For programs that shade single points, without shadows: why not, as a sentence.
std::string why_not_one_sphere(const Scene& scene);
bool has_point_lights(const Scene& scene);

/// One picture by one program. The scene is put into engine units (preparation.hpp) first.
SceneInput camera_scene(const Scene& scene, const std::string& name,
                        const ReferenceOptions& options,
                        const std::function<OwnHighlight(const Material&)>& own);

}  // namespace lobelia
