// The parts of bench_light, each of which prints its table and what limits it.
#pragma once

#include "renderer/scene/scene.hpp"

namespace lobelia::bench {

/// What RenderOptions::target_error promises and what it keeps.
void measure_target_error(const char* title, const Scene& scene);

int processors();
void measure_threads();
void measure_crowd();

}  // namespace lobelia::bench
