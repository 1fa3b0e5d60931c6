// Rendering a scene.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/image.hpp"
#include "renderer/plan/plan.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

struct RenderOptions {
  int threads = 0;  ///< 0: all processors
  EffectPolicy effects = EffectPolicy::kAsCalledFor;
  std::optional<Precision> precision;       ///< none: what the plan finds sufficient
  std::function<void(double)> on_progress;  ///< fraction done, from any thread, not in order
};

struct RenderResult {
  Image image;
  Plan plan;
  std::uint64_t camera_rays = 0, shadow_rays = 0;  ///< counted, not estimated
  double plan_seconds = 0, render_seconds = 0;
  std::string instruction_set;  ///< "AVX2", as chosen for this processor
};

/// The same picture for the same scene, bit for bit, whatever the number of threads.
/// Throws Error(kInterrupted) on Ctrl-C.
RenderResult render(const Scene& scene, const RenderOptions& options);

}  // namespace lobelia
