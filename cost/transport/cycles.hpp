// Blender Cycles on the scenes of sphere_on_plane().
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::cost {

struct CyclesPicture {
  int width = 0, height = 0, samples = 1;
  std::uint64_t seed = 0;
  double seconds = 0;  ///< filled: of the render call
  Image image;         ///< filled
};

/// Renders them all in one process, in order, with one thread a processor. Returns the seconds of the
/// whole process. Throws Error(kEngine).
double run_cycles(const std::filesystem::path& program, const Scene& scene,
                  const std::filesystem::path& directory, std::vector<CyclesPicture>& pictures);

}  // namespace lobelia::cost
