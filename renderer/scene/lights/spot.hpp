// Light from a point in a cone: full within the beam, and from there to the cutoff as a smooth step of the cosine, as
// POV-Ray's spotlight of tightness 0 falls.
#ifndef LOBELIA_RENDERER_SCENE_LIGHTS_SPOT_HPP
#define LOBELIA_RENDERER_SCENE_LIGHTS_SPOT_HPP

#include <fmt/core.h>

#include "renderer/scene/lights/light.hpp"

namespace lobelia {

struct SpotLight {
  Vec3 position;
  Vec3 direction;  ///< of the middle of the cone, where the light travels; unit length
  Rgb intensity;  ///< W/sr along `direction`, >= 0; irradiance falls with the square of the distance
  double cutoff_angle;  ///< degrees from `direction` to where the light ends, to 90
  double beam_width;    ///< degrees from `direction` to where it begins to fall, below cutoff_angle

  static constexpr LightInfo kInfo{"spot", "a light in a point that shines in a cone",
                                   LightKind::kDelta};
  static constexpr auto parameters() {
    return std::to_array<LightParameter<SpotLight>>({
        {{"position", ParameterType::kPoint, "", -kFar, kFar, "", "where the light stands"},
         &SpotLight::position},
        {{"direction", ParameterType::kVector, "", -kFar, kFar, "",
          "where the light travels in the middle of the cone"},
         &SpotLight::direction},
        {{"intensity", ParameterType::kRgb, "1", 0, kBrightest, "W/sr",
          "in the middle of the cone; irradiance is intensity / distance^2"},
         &SpotLight::intensity},
        {{"cutoff_angle", ParameterType::kFloat, "20", 0.01, 90, "degrees",
          "from the direction to where the light ends"},
         &SpotLight::cutoff_angle},
        {{"beam_width", ParameterType::kFloat, "15", 0, 90, "degrees",
          "from the direction to where it begins to fall, as a smooth step of the cosine; below "
          "cutoff_angle"},
         &SpotLight::beam_width},
    });
  }
  void finish(LightSource& source) {
    if (length(direction) > 0)
      direction = as_unit(direction);
    else
      source.error("", "direction is zero; allowed: any other vector");
    if (!(beam_width < cutoff_angle))
      source.error(
          "", fmt::format("beam_width {:g} is not below cutoff_angle {:g}, where the light ends",
                          beam_width, cutoff_angle));
  }

  Rgb strength() const { return intensity; }
  LightBounds bounds() const { return {LightBounds::kBall, position}; }
  Lamp lamp() const {
    Lamp lamp = Lamp::near(position, intensity, direction);
    lamp.spot = {beam_width, cutoff_angle};
    return lamp;
  }

  bool operator==(const SpotLight&) const = default;
};
static_assert(LightType<SpotLight>);

}  // namespace lobelia

#endif

#ifdef LOBELIA_LIGHT_KERNELS
HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

inline void sample_light(const SpotLight& light, std::size_t count, const Vec3Chunk& point,
                         LightSamples& drawn) {
  const Lanes3 direction = broadcast(light.direction);
  const SpotCone cone{light.beam_width, light.cutoff_angle};
  const Lanes least(cone.least_cosine()), step(1 / cone.cosine_step()), one(1.0);
  sample_point(light.position, count, point, drawn, [&](Lanes factor, Lanes3 to_light) HWY_ATTR {
    const Lanes along = Lanes(0.0) - dot(direction, to_light);
    const Lanes t = clamp((along - least) * step, Lanes(0.0), one);
    return factor * t * t * (Lanes(3.0) - Lanes(2.0) * t);
  });
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
