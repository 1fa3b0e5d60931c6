// The inner loops, chosen at run time for the processor. They work on chunks of rays as structures of arrays, so that
// model, lobe and effects are chosen once a chunk.
#pragma once

#include "renderer/precision.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// The most rays in a chunk; a multiple of every register's lanes.
inline constexpr std::size_t kChunk = 512;

struct Vec3Chunk {
  alignas(64) double x[kChunk], y[kChunk], z[kChunk];
};

/// Kernels compute whole registers: lanes from `count` up to the next multiple of 16 hold any values.
struct KernelTable {
  /// 1 if no sphere of `occluders` stands between point and light, otherwise 0.
  void (*visibility)(const std::vector<Sphere>& spheres, const std::vector<int>& occluders,
                     std::size_t count, const Vec3Chunk& point, const Vec3Chunk& to_light,
                     const double* distance, double* visible);

  /// Lobe times geometry_factor(): radiance per unit irradiance without the coefficient, 0 where N.L <= 0.
  using Shade = void (*)(const Highlight& highlight, std::size_t count, const Vec3Chunk& normal,
                         const Vec3Chunk& to_eye, const Vec3Chunk& to_light, double* specular);
  Shade (*shade)(const Highlight& highlight, Precision precision);

  /// The lobe alone, in float32.
  using LobeValue = void (*)(const Highlight& highlight, std::size_t count, const float* s,
                             float* value);
  LobeValue (*lobe32)(LobeId lobe);

  /// (1 - V.H)^5, the weight of 1 against F0 in Schlick's Fresnel factor.
  void (*fresnel)(std::size_t count, const Vec3Chunk& to_eye, const Vec3Chunk& to_light,
                  double* weight);

  /// max(N.L, 0)
  void (*cosine)(std::size_t count, const Vec3Chunk& normal, const Vec3Chunk& to_light,
                 double* n_dot_l);

  /// Unit vectors to the eye of camera rays through film positions (u, v) at distance 1 (multiples of right and
  /// up), from the point of the lens at `lens_u` and `lens_v` times the focus distance.
  void (*camera_rays)(const CameraFrame& camera, std::size_t count, const double* u,
                      const double* v, const double* lens_u, const double* lens_v,
                      Vec3Chunk& to_eye);

  /// The index, or -1, and the distance of the nearest sphere in front, except spheres that the ray starts in or
  /// on, and the sphere `leaves` (-1: none). Rays run opposite to `to_eye`.
  void (*nearest_sphere)(const std::vector<Sphere>& spheres, std::size_t count,
                         const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* leaves,
                         double* index, double* distance);

  /// Points and unit normals where rays enter the spheres that they meet, given by centre and radius.
  void (*surface)(std::size_t count, const Vec3Chunk& origin, const Vec3Chunk& to_eye,
                  const Vec3Chunk& center, const double* radius, Vec3Chunk& point,
                  Vec3Chunk& normal);

  /// Replaces index and distance where a ray meets the plane nearer than `distance`, except rays that start on it.
  void (*nearest_plane)(const Plane& plane, double plane_index, std::size_t count,
                        const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* leaves,
                        double* index, double* distance);
  /// Sets point and normal, towards the eye, of the rays that have met that plane.
  void (*plane_surface)(const Plane& plane, double plane_index, std::size_t count,
                        const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* index,
                        const double* distance, Vec3Chunk& point, Vec3Chunk& normal);
  /// Sets `visible` to 0 if the plane is between point and light.
  void (*plane_hides)(const Plane& plane, std::size_t count, const Vec3Chunk& point,
                      const Vec3Chunk& to_light, const double* distance, double* visible);

  /// Random directions about the normals, with a density proportional to their cosine.
  void (*scatter_evenly)(std::size_t count, const Vec3Chunk& normal, const double* u,
                         const double* v, Vec3Chunk& to_light);

  /// Pairs of random numbers (renderer/sobol.hpp), one for each hash of a pixel and index of a sample.
  void (*random)(std::size_t count, const std::uint32_t* pixel, const std::uint32_t* index,
                 std::uint32_t dimension, double* u, double* v);

  const char* instruction_set;  ///< "AVX2"
};

/// KernelTable::shade of Precision::kFloat16, the same on every processor: it emulates one point after another. N.L and
/// all that follows the lobe are float64, as in the other precisions.
KernelTable::Shade float16_shade(const Highlight& highlight);

/// For this processor; decided once.
const KernelTable& kernels();

}  // namespace lobelia
