// The inner loops, chosen at run time for the processor. They work on chunks of rays held as
// structures of arrays, so that the choice of model, lobe and effects is made once a chunk.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "renderer/highlight.hpp"
#include "renderer/precision.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Rays in a chunk at most; a multiple of every register's lanes.
inline constexpr std::size_t kChunk = 512;

struct Vec3Chunk {
  alignas(64) double x[kChunk], y[kChunk], z[kChunk];
};

/// Kernels run over whole registers: lanes from `count` up to the next multiple of 16 are computed too,
/// from whatever stands there, and are to be ignored.
struct KernelTable {
  /// 1 where no sphere of `occluders` stands between point and light, else 0.
  void (*visibility)(const std::vector<Sphere>& spheres, const std::vector<int>& occluders,
                     std::size_t count, const Vec3Chunk& point, const Vec3Chunk& to_light,
                     const double* distance, double* visible);

  /// Lobe times foreshortening (radiance per unit irradiance without the coefficient), 0 where
  /// N.L <= 0.
  using Shade = void (*)(const Highlight& highlight, std::size_t count, const Vec3Chunk& normal,
                         const Vec3Chunk& to_eye, const Vec3Chunk& to_light, double* specular);
  Shade (*shade)(const Highlight& highlight, Precision precision);

  /// The lobe alone, in float32.
  using LobeValue = void (*)(const Highlight& highlight, std::size_t count, const float* s,
                             float* value);
  LobeValue (*lobe32)(LobeId lobe);

  /// (1 - V.H)^5, by which Schlick's Fresnel factor goes from its value at normal incidence to 1.
  void (*fresnel)(std::size_t count, const Vec3Chunk& to_eye, const Vec3Chunk& to_light,
                  double* weight);

  /// max(N.L, 0)
  void (*cosine)(std::size_t count, const Vec3Chunk& normal, const Vec3Chunk& to_light,
                 double* n_dot_l);

  const char* instruction_set;  ///< "AVX2"
};

/// For this processor; decided once.
const KernelTable& kernels();

}  // namespace lobelia
