// Directions towards lights with a size, and what rays meet of them, a chunk at a time. As kernels.hpp.
#pragma once

#include <cstddef>

#include "renderer/kernels/kernels.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// A rectangle with its axes worked out.
struct PreparedRectangle {
  explicit PreparedRectangle(const RectangleLight& light);
  Vec3 center, x, y, z;  ///< unit; it shines towards +z
  double half_x, half_y;
};

/// Drawn directions, one for each point and pair (u, v) in [0, 1): the unit vector, the distance to the
/// light, and 1 / (density per steradian), which is 0 where there is nothing to draw.
struct DrawnChunk {
  Vec3Chunk to_light{};
  alignas(64) double distance[kChunk]{}, inverse_pdf[kChunk]{};
};

/// What rays meet: the distance (infinite where they miss), and the density with which the light would
/// have drawn their direction.
struct MetChunk {
  alignas(64) double distance[kChunk]{}, pdf[kChunk]{};
};

struct LightKernels {
  void (*sample_sphere)(const SphereLight& light, std::size_t count, const Vec3Chunk& point,
                        const double* u, const double* v, DrawnChunk& drawn);
  void (*sample_rectangle)(const PreparedRectangle& light, std::size_t count,
                           const Vec3Chunk& point, const double* u, const double* v,
                           DrawnChunk& drawn);
  /// Rays run opposite to `to_eye`. Without `densities` only distances are computed.
  void (*meet_sphere)(const SphereLight& light, std::size_t count, const Vec3Chunk& origin,
                      const Vec3Chunk& to_eye, bool densities, MetChunk& met);
  void (*meet_rectangle)(const PreparedRectangle& light, std::size_t count, const Vec3Chunk& origin,
                         const Vec3Chunk& to_eye, bool densities, MetChunk& met);
};

const LightKernels& light_kernels();

}  // namespace lobelia
