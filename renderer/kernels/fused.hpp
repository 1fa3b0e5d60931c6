// The inner loop of the simple pictures: ray, sphere, lights and the three floats of a pixel in one go,
// all of it in registers. Compiled for each combination of lobe, angle, foreshortening, precision and
// effects; made for one sphere of one picture, with the lobe's constants worked out.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "renderer/highlight.hpp"
#include "renderer/precision.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Pixels are computed in blocks of as many: a multiple of every register's lanes.
inline constexpr int kFusedBlock = 16;

/// The part of a light that is the same for all pixels.
struct FusedLight {
  bool is_directional = true;
  Vec3 vector;    ///< to the light, or where it stands
  Rgb specular;   ///< strength times specular reflectance times coefficient
  Rgb grazing{};  ///< what Schlick's factor adds to it at grazing angles, at most
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
  bool wins_ties;  ///< the first of the scene does
};

class FusedKernel {
 public:
  virtual ~FusedKernel() = default;
  /// The pixels begin..end - 1 of a row; begin is a multiple of kFusedBlock, and so is end where it is
  /// not the row's. With `rivals` it adds to what is there and leaves pixels alone where one of them is
  /// in front; otherwise it overwrites.
  virtual void render(const FusedRow& row, int begin, int end,
                      std::span<const FusedRival> rivals) const = 0;
};

/// For this processor.
std::unique_ptr<const FusedKernel> make_fused_kernel(const FusedSphere& sphere);

/// By effects, one file each so that they are compiled side by side.
std::unique_ptr<const FusedKernel> make_fused_plain(const FusedSphere& sphere);
std::unique_ptr<const FusedKernel> make_fused_diffuse(const FusedSphere& sphere);
std::unique_ptr<const FusedKernel> make_fused_fresnel(const FusedSphere& sphere);
std::unique_ptr<const FusedKernel> make_fused_diffuse_fresnel(const FusedSphere& sphere);

}  // namespace lobelia
