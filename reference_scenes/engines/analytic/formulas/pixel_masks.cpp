#include <oneapi/tbb/parallel_for.h>

#include <bit>

#include "base/system/error.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "reference_scenes/engines/analytic/formulas/tracer.hpp"
#include "renderer/pixel_ray.hpp"

namespace lobelia::truth {
namespace {

/// A hash of everything that makes shading jump: surface, checker square, visible lights. Two situations collide with a
/// probability of 2^-64.
class Situation {
 public:
  void note(std::uint64_t value) {
    // SplitMix64's finaliser.
    state_ += 0x9e3779b97f4a7c15 + value;
    state_ = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9;
    state_ = (state_ ^ (state_ >> 27)) * 0x94d049bb133111eb;
    state_ ^= state_ >> 31;
  }
  void note(double value) { note(std::bit_cast<std::uint64_t>(value + 0.0)); }  // -0 is 0
  std::uint64_t number() const { return state_; }

 private:
  std::uint64_t state_ = 0;
};

std::uint64_t situation(const Scene& scene, const Tracer<double>& tracer, double x, double y) {
  Situation situation;
  tracer.follow(x, y, [&](const Met<double>& met) {
    situation.note(std::uint64_t(met.surface));
    situation.note(met.square_u);
    situation.note(met.square_v);
    for (std::size_t light = 0; light < scene.lights.size(); ++light)
      situation.note(std::uint64_t(tracer.arrival(light, met).has_value()));
  });
  return situation.number();
}

}  // namespace

PixelFlags edge_ring(const Scene& scene) {
  if (const std::string why = why_not_evaluated(scene); !why.empty())
    throw Error(ExitCode::kInput, why);
  const Tracer<double> tracer(scene);
  // One ray per pixel is enough, because neighbours share their rays; with a frame of one pixel around the picture.
  const int width = scene.film.width, height = scene.film.height, stride = width + 2;
  std::vector<std::uint64_t> seen(std::size_t(stride) * (height + 2));
  oneapi::tbb::parallel_for(0, height + 2, [&](int y) {
    for (int x = 0; x < stride; ++x)
      seen[std::size_t(y) * stride + x] = situation(scene, tracer, x - 0.5, y - 0.5);
  });
  PixelFlags ring(std::size_t(width) * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int v = y; v <= y + 2; ++v)
        for (int u = x; u <= x + 2; ++u)
          if (seen[std::size_t(v) * stride + u] != seen[std::size_t(y + 1) * stride + x + 1])
            ring[std::size_t(y) * width + x] = 1;
  return ring;
}

std::int64_t mark_grazing(const Scene& scene, double least_cosine, PixelFlags& ring) {
  if (const std::string why = why_not_evaluated(scene); !why.empty())
    throw Error(ExitCode::kInput, why);
  if (least_cosine <= 0) return 0;
  const Tracer<double> tracer(scene);
  std::int64_t grazing = 0;
  for (int y = 0, i = 0; y < scene.film.height; ++y)
    for (int x = 0; x < scene.film.width; ++x, ++i) {
      bool grazes = false;
      tracer.follow(x + 0.5, y + 0.5, [&](const Met<double>& met) {
        for (std::size_t light = 0; light < scene.lights.size(); ++light)
          if (const auto arrival = tracer.arrival(light, met))
            grazes = grazes || arrival->n_dot_l < least_cosine;
      });
      if (!grazes) continue;
      ring[std::size_t(i)] = 1;
      ++grazing;
    }
  return grazing;
}

PixelFlags surface_mask(const Scene& scene) {
  if (scene.spheres.size() > kMaxSpheresByRay)
    throw Error(ExitCode::kInput, "a mask is of up to {} spheres; this scene has {}",
                kMaxSpheresByRay, scene.spheres.size());
  const Tracer<double> tracer(scene);
  const int width = scene.film.width, height = scene.film.height;
  PixelFlags mask(std::size_t(width) * std::size_t(height));
  oneapi::tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x)
      if (tracer.meet(tracer.camera_origin(), tracer.camera_ray(x + 0.5, y + 0.5)))
        mask[std::size_t(y) * std::size_t(width) + std::size_t(x)] = 1;
  });
  return mask;
}

}  // namespace lobelia::truth
