#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/error.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "reference_scenes/engines/analytic/formulas/tracer.hpp"
#include "renderer/pixel_ray.hpp"

namespace lobelia::truth {

std::vector<std::uint8_t> surface_mask(const Scene& scene) {
  if (scene.spheres.size() > kMaxSpheresByRay)
    throw Error(ExitCode::kInput, fmt::format("a mask is of up to {} spheres; this scene has {}",
                                              kMaxSpheresByRay, scene.spheres.size()));
  const Tracer<double> tracer(scene);
  const int width = scene.film.width, height = scene.film.height;
  std::vector<std::uint8_t> mask(std::size_t(width) * std::size_t(height), 0);
  oneapi::tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x)
      if (tracer.meet(tracer.camera_origin(), tracer.camera_ray(x + 0.5, y + 0.5)))
        mask[std::size_t(y) * std::size_t(width) + std::size_t(x)] = 1;
  });
  return mask;
}

}  // namespace lobelia::truth
