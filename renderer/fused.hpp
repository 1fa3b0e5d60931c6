// Pictures of a few spheres without shadows, one ray a pixel: each row is cut into the pixels that a
// sphere can cover, found from its outline, and one kernel does all that such a pixel needs
// (renderer/kernels/fused.hpp). Bit for bit the picture that the kernels one by one make.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "renderer/kernels/fused.hpp"
#include "renderer/plan/plan.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/work.hpp"

namespace lobelia {

/// Columns begin..end - 1.
struct PixelSpan {
  int begin = 0, end = 0;
};

class FusedRenderer {
 public:
  /// Whether the scene is of this kind and the plan asks for no more.
  static bool can_render(const Scene& scene, const Plan& plan);

  /// The scene must be of that kind.
  FusedRenderer(const Scene& scene, const Plan& plan);

  /// The rows y0..y1 - 1, 3 * width floats each, all of them written. From any thread.
  void render_rows(int y0, int y1, float* rgb) const;

  /// The work so far. Pixels that no sphere can cover take none.
  Work work() const;
  /// In words, for the plan.
  static std::string kernel_text();

 private:
  struct Outline {
    double ahead, aside, above;  ///< the way to the centre in the camera's frame
    double tangent_squared;      ///< of the length of a tangent from the eye; the least it may be
    bool whole_rows;             ///< nothing is known: the eye is in the sphere or close to it
  };
  struct Body {
    Outline outline;
    FusedRival rival;
    std::unique_ptr<const FusedKernel> kernel;
    bool diffuse, fresnel;
  };

  PixelSpan span(const Outline& outline, double v) const;
  void render_row(int y, float* rgb) const;
  void render_group(const FusedRow& row, const int* spheres, int count, const PixelSpan* spans,
                    PixelSpan all) const;

  int width_, height_;
  CameraFrame frame_;
  std::vector<double> columns_;
  std::vector<Body> bodies_;
  std::uint64_t lights_;
  mutable std::atomic<std::uint64_t> rays_{0}, diffuse_{0}, fresnel_{0};
};

}  // namespace lobelia
