// Rendering a scene.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/image.hpp"
#include "renderer/plan/plan.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/work.hpp"

namespace lobelia {

/// Takes finished rows, from the top down: `rows` of them from row `y` on, 3 * width floats each. Called
/// by one thread at a time, while other rows are being rendered.
using RowSink = std::function<void(int y, int rows, const float* rgb)>;

struct RenderOptions {
  int threads = 0;  ///< 0: all processors
  EffectPolicy effects = EffectPolicy::kAsCalledFor;
  std::optional<Precision> precision;  ///< none: what the plan finds sufficient
  Experiment experiment = {};
  bool allow_fused = true;  ///< where a picture is simple enough; it makes no difference to it
  std::function<void(double)> on_progress;  ///< fraction done, from any thread, not in order

  /// Where one of these two is given, samples are taken in rounds, each as many as all before, until
  /// the estimated error is reached, or another round would take too long, or no more are allowed. At
  /// least one sample a pixel is taken.
  std::optional<double>
      target_error;                  ///< of RenderResult::error; takes as many samples as it needs
  std::optional<double> time_limit;  ///< seconds of rendering; takes the scene's samples at most
  std::optional<int> max_samples;    ///< a pixel, whatever the scene or the target asks for
};

struct RenderResult {
  Image image;  ///< empty where a RowSink took it
  Plan plan;
  Work work;                ///< counted, not estimated
  int samples = 0;          ///< that each pixel took, or at most where antialiasing chose pixels
  std::string stop_reason;  ///< in words, where the render could stop before all samples were taken
  /// Where something is random and pixels have two samples or more (three, if the filter is negative
  /// somewhere): the root mean square over the picture of how far pixels are expected to be off, over
  /// the root mean square of the picture. From the two halves of the samples; more than the truth
  /// rather than less, for together they are spread more evenly than each.
  std::optional<double> error;
  double plan_seconds = 0, render_seconds = 0;
  std::string instruction_set;  ///< "AVX2", as chosen for this processor
};

/// The same picture for the same scene, bit for bit, whatever the number of threads (with a time limit:
/// for the same number of samples). Throws Error(kInterrupted) on Ctrl-C, and whatever the sink throws.
RenderResult render(const Scene& scene, const RenderOptions& options);

/// Hands the picture over in rows, and holds only some of them in memory at a time, unless samples are
/// taken in rounds.
RenderResult render(const Scene& scene, const RenderOptions& options, const RowSink& sink);

}  // namespace lobelia
