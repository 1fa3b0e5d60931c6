// A light that rays can sample and meet, made once for a picture.
#pragma once

#include "renderer/kernels/kernels.hpp"
#include "renderer/scene/lights/lights.hpp"

namespace lobelia {

/// A direction from each point to the light: the unit vector, the distance, and the factor on the light's strength.
/// The factor is the fall-off with distance, or 1 / (density per steradian) of a random direction. Where it is not
/// over 0 there is no direction, and the other values mean nothing.
struct LightSamples {
  Vec3Chunk to_light{};
  alignas(64) double distance[kChunk]{}, factor[kChunk]{};
  /// The radiance that arrives, if it varies with the direction.
  std::array<Rgb, kChunk> radiance;
};

/// The distance at which rays meet a light (infinite: they miss it), and the density with which the light draws their
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
                    bool densities, LightMeetings& met) const = 0;
  /// For environments: one direction to the bright part for each pair (u, v), with its radiance.
  virtual void sample_bright(std::size_t count, const double* u, const double* v,
                             LightSamples& drawn) const = 0;
  /// Whether there is one. False for all other lights.
  virtual bool has_bright() const = 0;
  /// For environments: what rays see that run opposite to `to_eye`.
  virtual void look(std::size_t count, const Vec3Chunk& to_eye, EnvironmentLook* looks) const = 0;
  virtual EnvironmentLook look(Vec3 direction) const = 0;

  /// A random lamp. The average of such lamps is the light.
  virtual Lamp lamp(double u, double v) const = 0;
  /// For area lights, as AreaLight::distance(). For the references, independent of the kernels above.
  virtual double distance(Vec3 origin, Vec3 direction) const = 0;
};

std::unique_ptr<const PreparedLight> prepare(const Light& light);
/// One for each light of a scene.
std::vector<std::unique_ptr<const PreparedLight>> prepare(const std::vector<Light>& lights);

}  // namespace lobelia
