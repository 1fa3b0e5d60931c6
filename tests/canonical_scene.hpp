// The scenes that the program comes with.
#pragma once

#include <string>

#include "lobelia_paths.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {

inline Scene canonical_scene(const std::string& name) {
  return read_scene(std::string(LOBELIA_SOURCE_DIR) + "/reference_scenes/scenes/" + name + ".xml");
}

}  // namespace lobelia
