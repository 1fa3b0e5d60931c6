// Light from a point, in every direction or as from a point on a surface.
#ifndef LOBELIA_RENDERER_SCENE_LIGHTS_POINT_HPP
#define LOBELIA_RENDERER_SCENE_LIGHTS_POINT_HPP

#include "renderer/scene/lights/light.hpp"

namespace lobelia {

struct PointLight {
  Vec3 position;
  Rgb intensity;  ///< W/sr, >= 0; irradiance falls with the square of the distance
  /// The unit normal of a surface that the point is on: the intensity falls with the cosine to it, and is 0 behind.
  /// Zero: the same intensity in every direction.
  Vec3 normal = {};

  static constexpr LightInfo kInfo{"point", "a light in a point", LightKind::kDelta};
  static constexpr auto parameters() {
    return std::to_array<LightParameter<PointLight>>({
        {{"position", ParameterType::kPoint, "", -kFar, kFar, "", "where the light stands"},
         &PointLight::position},
        {{"intensity", ParameterType::kRgb, "1", 0, kBrightest, "W/sr",
          "irradiance is intensity / distance^2"},
         &PointLight::intensity},
        {{"normal", ParameterType::kVector, "0, 0, 0", -kFar, kFar, "",
          "of a point of a surface: the intensity falls with the cosine to it; 0, 0, 0 shines "
          "everywhere"},
         &PointLight::normal,
         true},
    });
  }
  void finish(LightSource&) { normal = length(normal) > 0 ? as_unit(normal) : Vec3{}; }

  Rgb strength() const { return intensity; }
  LightBounds bounds() const { return {LightBounds::kBall, position}; }
  Lamp lamp() const { return Lamp::near(position, intensity, normal); }

  bool operator==(const PointLight&) const = default;
};
static_assert(LightType<PointLight>);

}  // namespace lobelia

#endif

#ifdef LOBELIA_LIGHT_KERNELS
HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

inline void sample_light(const PointLight& light, std::size_t count, const Vec3Chunk& point,
                         LightSamples& drawn) {
  const Lanes3 normal = broadcast(light.normal);
  const bool falls_with_cosine = light.lamp().has_normal();
  sample_point(light.position, count, point, drawn, [&](Lanes factor, Lanes3 to_light) HWY_ATTR {
    return falls_with_cosine ? factor * positive_part(Lanes(0.0) - dot(normal, to_light)) : factor;
  });
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
