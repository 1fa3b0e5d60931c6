// Renders pictures of a few spheres without shadows, with one ray a pixel. In each row it finds the pixels that a
// sphere can cover from the sphere's outline, without those where its highlights are 0, and renders them by one kernel
// (renderer/kernels/fused.hpp). The picture is the same bit for bit as that of the separate kernels.
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
  /// Whether the scene is that simple, and the plan asks for no more.
  static bool can_render(const Scene& scene, const Plan& plan);

  /// For a scene that it can render.
  FusedRenderer(const Scene& scene, const Plan& plan);

  /// Writes the rows y0..y1 - 1, 3 * width floats each. From any thread. Of memory that is zero already, only the pixels
  /// that may shine are touched.
  void render_rows(int y0, int y1, float* rgb, bool is_zero = false) const;

  /// Rows that one task renders: few enough that 64 cores share a picture of 1024 x 1024 evenly, so many that the
  /// scheduler's own time, some tenths of a microsecond a task, does not count.
  static int rows_of_task(int width) { return std::max(1, kPixelsOfTask / width); }

  /// The work so far; none for pixels that are known to be black.
  Work work() const;
  /// A description for the plan.
  static std::string kernel_text();

 private:
  static constexpr int kPixelsOfTask = 2048;

  struct Outline {
    double ahead, aside, above;  ///< from the eye to the centre, in the camera's frame
    double tangent_squared;      ///< lower bound of a tangent from the eye, squared
    bool whole_rows;             ///< the eye is too close to the sphere for an outline
  };
  struct Body {
    Outline outline;
    std::vector<Outline> lit;  ///< of balls beyond which it is black; none: it may shine everywhere
    FusedRival rival;
    std::unique_ptr<const FusedKernel> kernel;
    bool diffuse, fresnel;
  };

  Outline outline_of(const Sphere& sphere) const;
  PixelSpan span(const Outline& outline, double v) const;
  PixelSpan lit_span(const Body& body, PixelSpan whole, double v) const;
  void render_row(int y, float* rgb, bool is_zero) const;
  void render_group(const FusedRow& row, const int* spheres, int count, const PixelSpan* lit,
                    PixelSpan all) const;

  int width_, height_;
  CameraFrame frame_;
  std::vector<double> columns_;
  std::vector<Body> bodies_;
  std::uint64_t lights_;
  mutable std::atomic<std::uint64_t> rays_{0}, diffuse_{0}, fresnel_{0};
};

}  // namespace lobelia
