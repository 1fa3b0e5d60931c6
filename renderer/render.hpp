// Rendering a scene.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/pictures/image.hpp"
#include "renderer/plan/plan.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/work.hpp"

namespace lobelia {

/// Takes `rows` finished rows from row `y` on, from the top down, 3 * width floats each. Called by one thread at a
/// time, while other rows are being rendered.
using RowSink = std::function<void(int y, int rows, const float* rgb)>;

struct RenderOptions {
  int threads = 0;  ///< 0: all processors
  EffectPolicy effects = EffectPolicy::kAsCalledFor;
  std::optional<Precision> precision;  ///< none: the plan chooses
  Experiment experiment = {};
  bool allow_fused = true;  ///< for simple pictures; it does not change the picture
  /// Pixels that are rendered together for a RowSink, rounded to rows of tiles; it does not change the picture.
  int band_pixels = 4 << 20;
  std::function<void(double)> on_progress;  ///< fraction done, from any thread, not in order

  /// With a target or a time limit, samples are taken in rounds, each as many as all before, until the estimated
  /// error is reached, another round would take too long, or no more are allowed. At least one sample a pixel.
  std::optional<double>
      target_error;  ///< of RenderResult::error, whatever samples the scene asks for
  std::optional<double> time_limit;  ///< seconds of rendering; takes the scene's samples at most
  std::optional<int> max_samples;    ///< a pixel, whatever the scene or the target asks for
};

struct RenderResult {
  Image image;  ///< empty where a RowSink took it
  Plan plan;
  Work work;                ///< counted, not estimated
  int samples = 0;          ///< of each pixel; the most where antialiasing chose pixels
  std::string stop_reason;  ///< in words, if the render could stop before all samples were taken
  /// The expected error of a pixel, root mean square over the picture, over the root mean square of the picture.
  /// Given if something is random and pixels have two samples or more (three with a filter that is negative
  /// somewhere). Estimated from the two halves of the samples, rather too large: together they are spread more
  /// evenly.
  std::optional<double> error;
  double plan_seconds = 0, render_seconds = 0;
  double build_seconds =
      0;  ///< part of render_seconds: building what rays are searched with, and releasing it
  std::string instruction_set;  ///< "AVX2", as chosen for this processor
};

/// Gives the same picture for the same scene, bit for bit, with any number of threads (with a time limit: for the
/// same number of samples). Throws Error(kInterrupted) on Ctrl-C, and whatever the sink throws. With a sink, hands
/// the picture over in rows and holds only some of them in memory, unless samples are taken in rounds. Throws
/// Error(kInput) where the whole picture would be over kMaxImagePixels.
RenderResult render(const Scene& scene, const RenderOptions& options, const RowSink& sink = {});

/// Renders that a standard error is computed from, and its degrees of freedom.
inline constexpr int kErrorRenders = 16, kErrorFreedom = kErrorRenders - 1;

/// The standard error of each value of render(scene, options), from as many renders with the next seeds. Samples with
/// different seeds are independent, and so are pixels (renderer/sobol.hpp). 0 where nothing is random. Throws as
/// render().
Image standard_error_of_render(const Scene& scene, RenderOptions options);

}  // namespace lobelia
