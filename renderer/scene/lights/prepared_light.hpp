// A light ready to be drawn from and to be met by rays, made once for a picture.
#pragma once

#include <cstddef>
#include <memory>

#include "renderer/kernels/kernels.hpp"
#include "renderer/scene/lights/lights.hpp"

namespace lobelia {

/// A direction from each point to the light: the unit vector, the distance, and the factor on the light's
/// strength: how it falls with the distance, or 1 / (density per steradian) of what is drawn at random. Where that is
/// not over 0 there is nothing to draw, and the other values mean nothing.
struct LightSamples {
  Vec3Chunk to_light{};
  alignas(64) double distance[kChunk]{}, factor[kChunk]{};
  /// The radiance that arrives, if the light's varies.
  std::array<Rgb, kChunk> radiance;
};

/// Where rays meet a light: the distance (infinite if they miss it), and the density with which the light draws their
/// direction.
struct LightMeetings {
  alignas(64) double distance[kChunk]{}, pdf[kChunk]{};
};

/// As in kernels.hpp, whole registers are computed.
class PreparedLight {
 public:
  virtual ~PreparedLight() = default;

  /// One direction for each point and pair (u, v) in [0, 1).
  virtual void sample(std::size_t count, const Vec3Chunk& point, const double* u, const double* v,
                      LightSamples& drawn) const = 0;
  /// For area lights. Rays run opposite to `to_eye`. Without `densities` only distances are computed.
  virtual void meet(std::size_t count, const Vec3Chunk& origin, const Vec3Chunk& to_eye,
                    bool densities, LightMeetings& met) const;
  /// For environments.
  virtual EnvironmentLook look(Vec3 direction) const;

  /// A random lamp. The average of such lamps is the light.
  virtual Lamp lamp(double u, double v) const = 0;
  /// For area lights, as AreaLight. Without the kernels above, for the references.
  virtual double distance(Vec3 origin, Vec3 direction) const;
};

std::unique_ptr<const PreparedLight> prepare(const Light& light);
/// One for each light of a scene.
std::vector<std::unique_ptr<const PreparedLight>> prepare(const std::vector<Light>& lights);

}  // namespace lobelia
