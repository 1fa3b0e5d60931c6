// In place of the engines, in the fuzzed programs alone: a grid names them, and no more of them is needed.
#include <array>

#include "reference_scenes/engine.hpp"

namespace lobelia {

std::span<const EngineInfo> engine_infos() {
  static constexpr std::array<EngineInfo, 3> kInfos{{
      {.name = "povray", .title = "POV-Ray"},
      {.name = "blender", .title = "Cycles"},
      {.name = "analytic", .title = "Formulas"},
  }};
  return kInfos;
}

}  // namespace lobelia
