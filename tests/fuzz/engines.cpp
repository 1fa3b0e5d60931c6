// Replaces the engines in the fuzzed programs: a grid needs only their names, and those of the forms of scenes.
#include <array>

#include "reference_scenes/engine.hpp"
#include "reference_scenes/formats/catalogue.hpp"

namespace lobelia {

std::span<const EngineInfo> engine_infos() {
  static constexpr std::array<EngineInfo, 3> kInfos{{
      {.name = "povray", .title = "POV-Ray"},
      {.name = "blender", .title = "Cycles"},
      {.name = "analytic", .title = "Formulas"},
  }};
  return kInfos;
}

std::span<const SceneFormat> scene_formats() {
  static constexpr SceneFormat kFormats[] = {{.name = "lobelia"}};
  return kFormats;
}

}  // namespace lobelia
