// The parts of bench_light, each of which prints its table and what limits it.
#pragma once

#include <filesystem>

#include "core/image.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia::bench {

/// A picture with an error known to be small.
struct Converged {
  Image image;
  double error = 0;  ///< root mean square, expected from two halves
};

/// Time and error of both engines by number of samples, and time to equal error. `blender` and `lobelia`
/// may be empty. Returns our converged picture.
Converged compare_with_cycles(const char* title, const Scene& scene,
                              const std::filesystem::path& directory,
                              const std::filesystem::path& blender,
                              const std::filesystem::path& lobelia);

/// What RenderOptions::target_error promises and what it keeps.
void measure_target_error(const char* title, const Scene& scene, const Converged& truth);

void measure_threads();
void measure_crowd();

}  // namespace lobelia::bench
