// Warnings about a scene that can be rendered but is probably not meant that way.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// In words, with what it means for the picture: no light, a camera inside a sphere or turned away from
/// everything, a light inside a sphere. At most a few lines, whatever the number of spheres.
std::vector<std::string> remarks(const Scene& scene);

}  // namespace lobelia
