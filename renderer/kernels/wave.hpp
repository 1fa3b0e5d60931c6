// Kernels over rays that may start anywhere: from a lens, a mirror, a surface. As kernels.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/kernels/kernels.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

struct WaveKernels {
  /// Unit vectors back to the eye of camera rays through film positions (u, v) at distance 1 (multiples
  /// of right and up), from a point of the lens that is `lens_u` and `lens_v` of the focus distance
  /// aside.
  void (*camera_rays)(const CameraFrame& camera, std::size_t count, const double* u,
                      const double* v, const double* lens_u, const double* lens_v,
                      Vec3Chunk& to_eye);

  /// The nearest sphere in front, but for the one that the ray leaves (an index, or -1): its index or
  /// -1, and the distance. Rays run opposite to `to_eye`.
  void (*nearest_sphere)(const std::vector<Sphere>& spheres, std::size_t count,
                         const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* leaves,
                         double* index, double* distance);

  /// Where rays enter the spheres that they meet, given by centre and radius: points and unit normals.
  void (*surface)(std::size_t count, const Vec3Chunk& origin, const Vec3Chunk& to_eye,
                  const Vec3Chunk& center, const double* radius, Vec3Chunk& point,
                  Vec3Chunk& normal);

  /// Pairs of random numbers (renderer/sobol.hpp), one for each hash of a pixel and index of a sample.
  void (*random)(std::size_t count, const std::uint32_t* pixel, const std::uint32_t* index,
                 std::uint32_t dimension, double* u, double* v);
};

const WaveKernels& wave_kernels();

}  // namespace lobelia
