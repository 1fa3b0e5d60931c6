// Replaces the engines in the fuzzed programs: a grid needs only their names.
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
