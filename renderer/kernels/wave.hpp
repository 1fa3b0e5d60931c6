// Kernels over rays that may start anywhere: from a lens, a mirror, a surface. As kernels.hpp.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/kernels/kernels.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

struct WaveKernels {
  /// Unit directions of camera rays through film positions (u, v) at distance 1 (multiples of right and
  /// up), from a point of the lens that is `lens_u` and `lens_v` of the focus distance aside.
  void (*camera_rays)(const CameraFrame& camera, std::size_t count, const double* u,
                      const double* v, const double* lens_u, const double* lens_v,
                      Vec3Chunk& direction);

  /// The nearest sphere in front, but for the one that the ray leaves (an index, or -1): its index or
  /// -1, and the distance.
  void (*nearest_sphere)(const std::vector<Sphere>& spheres, std::size_t count,
                         const Vec3Chunk& origin, const Vec3Chunk& direction, const double* leaves,
                         double* index, double* distance);
};

const WaveKernels& wave_kernels();

}  // namespace lobelia
