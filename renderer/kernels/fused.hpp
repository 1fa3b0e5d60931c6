// The inner loop of simple pictures: from the ray to the three floats of a pixel in one kernel, whose values stay in the
// first-level cache. A kernel is made for one sphere of one picture, with the lobe's constants.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "renderer/highlight.hpp"
#include "renderer/precision.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Pixels of a block, which are computed together: a multiple of every register's lanes.
inline constexpr int kFusedBlock = 16;

/// The constants of a light for one sphere.
struct FusedLight {
  bool is_directional = true;
  Vec3 vector;    ///< direction to the light, or its position
  Rgb specular;   ///< strength times specular reflectance times coefficient
  Rgb grazing{};  ///< the most that Schlick's factor adds to it, at grazing angles
  Rgb diffuse{};  ///< strength times diffuse reflectance / pi
};

struct FusedSphere {
  Vec3 eye, center;
  double radius = 1;
  Highlight highlight;
  Precision precision = Precision::kFloat64;
  bool diffuse = false, fresnel = false;
  std::vector<FusedLight> lights;
};

/// One row of the picture: the ray of column x runs along forward + columns[x] right + v_up.
struct FusedRow {
  Vec3 forward, right, v_up;
  const double* columns = nullptr;  ///< readable up to the next multiple of kFusedBlock
  float* rgb = nullptr;             ///< of the whole row
};

/// Another sphere that may stand in front.
struct FusedRival {
  Vec3 center;
  double radius;
  bool wins_ties;  ///< it comes first in the scene
};

class FusedKernel {
 public:
  virtual ~FusedKernel() = default;
  /// Renders pixels begin..end - 1 of a row. `begin` is a multiple of kFusedBlock, and so is `end` unless it is the
  /// row's. Overwrites the pixels; with `rivals` it adds to them, and only where no rival is in front.
  virtual void render(const FusedRow& row, int begin, int end,
                      std::span<const FusedRival> rivals) const = 0;
};

/// For this processor.
std::unique_ptr<const FusedKernel> make_fused_kernel(const FusedSphere& sphere);

}  // namespace lobelia
