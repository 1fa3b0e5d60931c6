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

  /// The nearest sphere in front, but for those that the ray begins inside or on, and for the one that it
  /// leaves (an index, or -1): its index or -1, and the distance. Rays run opposite to `to_eye`.
  void (*nearest_sphere)(const std::vector<Sphere>& spheres, std::size_t count,
                         const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* leaves,
                         double* index, double* distance);

  /// Where rays enter the spheres that they meet, given by centre and radius: points and unit normals.
  void (*surface)(std::size_t count, const Vec3Chunk& origin, const Vec3Chunk& to_eye,
                  const Vec3Chunk& center, const double* radius, Vec3Chunk& point,
                  Vec3Chunk& normal);

  /// Where a ray meets the plane nearer than `distance`, but for rays that leave the plane itself: its
  /// index and the distance, in place of what was there.
  void (*nearest_plane)(const Plane& plane, double plane_index, std::size_t count,
                        const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* leaves,
                        double* index, double* distance);
  /// Point and normal, towards the eye, of the rays that have met that plane; others stay.
  void (*plane_surface)(const Plane& plane, double plane_index, std::size_t count,
                        const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* index,
                        const double* distance, Vec3Chunk& point, Vec3Chunk& normal);
  /// Makes `visible` 0 where the plane is between point and light.
  void (*plane_hides)(const Plane& plane, std::size_t count, const Vec3Chunk& point,
                      const Vec3Chunk& to_light, const double* distance, double* visible);

  /// Directions about the normals, as likely as their cosine.
  void (*scatter_evenly)(std::size_t count, const Vec3Chunk& normal, const double* u,
                         const double* v, Vec3Chunk& to_light);

  /// Pairs of random numbers (renderer/sobol.hpp), one for each hash of a pixel and index of a sample.
  void (*random)(std::size_t count, const std::uint32_t* pixel, const std::uint32_t* index,
                 std::uint32_t dimension, double* u, double* v);
};

const WaveKernels& wave_kernels();

}  // namespace lobelia
